#include "render/programs.h"

#include <utility>

#include "render/stage_look.h"

namespace clothsim {
namespace {

gl::Program makeNormals(bool withCuts, bool withStrain) {
  gl::Defines defines;
  if (withCuts) defines.emplace_back("CUTS", "");
  if (withStrain) defines.emplace_back("STRAIN", "");
  return gl::Program::makeCompute("render/normals.comp", defines);
}

// Of what is drawn for its depth alone.
gl::Program makeDepthOnly(const std::string& vertexFile, const ShadingModel& model) {
  gl::Defines defines;
  if (model.displaces) defines.emplace_back("DISPLACEMENT", "");
  if (model.isThick) defines.emplace_back("THICK", "");
  return gl::Program::makeRender(vertexFile, "render/depth_only.frag", defines);
}

gl::Program makeCloth(const ShadingModel& model, ClothLight light, const std::string& vertexFile,
                      const std::string& fragmentFile) {
  gl::Defines defines = model.defines;
  if (light == ClothLight::atVertices || light == ClothLight::plain)
    defines.emplace_back("LIT_AT_VERTICES", "");
  if (light == ClothLight::plain) defines.emplace_back("PLAIN", "");
  if (light == ClothLight::exposed) defines.emplace_back("EXPOSURE", "");
  return gl::Program::makeRender(vertexFile, fragmentFile, defines);
}

constexpr const char* clothVertices = "render/cloth.vert";
std::string shadingFile(const ShadingModel& model) { return "render/" + model.name + ".frag"; }

}  // namespace

RenderPrograms::RenderPrograms(const ShadingModel& model, const RenderSettings& settings, int samples) {
  chooseSamples(samples);
  chooseModel(model);
  chooseStage(settings);
}

ShadedPrograms::ShadedPrograms(const gl::Defines& stage, const gl::Defines& behind, bool forExposures) {
  gl::Defines defines = stage, backdropDefines = behind;
  if (forExposures)
    for (gl::Defines* each : {&defines, &backdropDefines}) each->emplace_back("EXPOSURE", "");
  backdrop = gl::Program::makeRender("render/fullscreen.vert", "render/backdrop.frag", backdropDefines);
  sphere = gl::Program::makeRender("render/sphere.vert", "render/sphere.frag", defines);
  shape = gl::Program::makeRender("render/shape.vert", "render/sphere.frag", defines);
  plane = gl::Program::makeRender("render/plane.vert", "render/plane.frag", defines);
  defines.emplace_back("LAY", "");
  layBackdrop = gl::Program::makeRender("render/fullscreen.vert", "render/backdrop.frag", defines);
}

MeanPrograms::MeanPrograms(int samples)
    : add(gl::Program::makeRender("render/fullscreen.vert", "render/resolve.frag",
                                  {{"SAMPLES", std::to_string(samples)}, {"ADDS", ""}})) {}

void RenderPrograms::chooseSamples(int samples) {
  resolve = samples == 1 ? gl::Program()
                         : gl::Program::makeRender("render/fullscreen.vert", "render/resolve.frag",
                                                   {{"SAMPLES", std::to_string(samples)}});
  samples_ = samples;
  mean_.reset();
}

void RenderPrograms::chooseModel(const ShadingModel& model) {
  gl::Program shading = makeCloth(model, ClothLight::atPixels, clothVertices, shadingFile(model));
  gl::Program depth = makeDepthOnly("render/cloth_depth.vert", model);
  clothShadow = makeDepthOnly("render/cloth_shadow.vert", model);
  clothDepth = std::move(depth);
  cloth_.clear();
  fuzz_.clear();
  cloth_.push_back({model.defines, ClothLight::atPixels, std::move(shading)});
  if (std::exchange(model_, model).measuresStrain == model.measuresStrain) return;
  normals_.reset();
  normalsWithCuts_.reset();
  meshNormals_.reset();
}

void RenderPrograms::chooseStage(const RenderSettings& settings) {
  ShadedPrograms shaded(stageDefines(settings), backdropDefines(settings), false);
  shaded_ = std::move(shaded);
  exposed_.reset();
  groundAlone_.reset();
  beyondAlone_.reset();
  stage_ = stageDefines(settings);
  behind_ = backdropDefines(settings);
}

const gl::Program& RenderPrograms::normals(bool withCuts) {
  auto& program = withCuts ? normalsWithCuts_ : normals_;
  if (!program) program.emplace(makeNormals(withCuts, model_.measuresStrain));
  return *program;
}

const gl::Program& RenderPrograms::meshNormals() {
  if (!meshNormals_)
    meshNormals_.emplace(gl::Program::makeCompute(
        "render/mesh_normals.comp", model_.measuresStrain ? gl::Defines{{"STRAIN", ""}} : gl::Defines{}));
  return *meshNormals_;
}

const gl::Program& RenderPrograms::diagonals() {
  if (!diagonals_) diagonals_.emplace(gl::Program::makeCompute("render/diagonals.comp"));
  return *diagonals_;
}

const LayerPrograms& RenderPrograms::layers() {
  if (!layers_) layers_.emplace();
  return *layers_;
}

const SmoothPrograms& RenderPrograms::smooth() {
  if (!smooth_) smooth_.emplace();
  return *smooth_;
}

const gl::Program& RenderPrograms::rim(bool ofLean) {
  auto& program = ofLean ? leanRim_ : rim_;
  if (!program)
    program.emplace(
        gl::Program::makeCompute("render/rim.comp", ofLean ? gl::Defines{{"LEAN", ""}} : gl::Defines{}));
  return *program;
}

const PickPrograms& RenderPrograms::picking() {
  if (!picking_) picking_.emplace();
  return *picking_;
}

const OverlayPrograms& RenderPrograms::overlays() {
  if (!overlays_) overlays_.emplace();
  return *overlays_;
}

const ShadedPrograms& RenderPrograms::shaded(bool forExposures) {
  auto& programs = forExposures ? exposed_ : shaded_;
  if (!programs) programs.emplace(stage_, behind_, forExposures);
  return *programs;
}

const gl::Program& RenderPrograms::backdropOf(BackdropShows shown) {
  if (shown == BackdropShows::both) return shaded(false).backdrop;
  const bool isGround = shown == BackdropShows::ground;
  auto& program = isGround ? groundAlone_ : beyondAlone_;
  if (program) return *program;
  gl::Defines defines = behind_;
  defines.emplace_back(isGround ? "GROUND_ALONE" : "BEYOND_ALONE", "");
  return program.emplace(gl::Program::makeRender("render/fullscreen.vert", "render/backdrop.frag", defines));
}

const gl::Program& RenderPrograms::made(std::vector<ClothProgram>& programs, const ShadingModel& model,
                                        ClothLight light, const std::string& vertexFile,
                                        const std::string& fragmentFile) {
  for (const ClothProgram& known : programs)
    if (known.light == light && known.defines == model.defines) return known.program;
  programs.push_back({model.defines, light, makeCloth(model, light, vertexFile, fragmentFile)});
  return programs.back().program;
}

const gl::Program& RenderPrograms::cloth(const ShadingModel& model, ClothLight light) {
  return made(cloth_, model, light, clothVertices, shadingFile(model));
}

const gl::Program& RenderPrograms::fuzz(const ShadingModel& model, ClothLight light) {
  return made(fuzz_, model, light, "render/fuzz.vert", "render/fuzz.frag");
}

const EdgePrograms& RenderPrograms::edges() {
  if (!edges_) edges_.emplace();
  return *edges_;
}

const MeanPrograms& RenderPrograms::mean() {
  if (!mean_) mean_.emplace(samples_);
  return *mean_;
}

void tryAllShaders(const RenderSettings& settings, int samples) {
  RenderSettings other = settings;
  RenderPrograms programs(shadingModelOf(other), settings, samples);
  for (const std::string_view background : backgrounds) {
    other.background = background;
    programs.chooseStage(other);
  }
  other.background = "studio";
  for (const std::string_view stage : stages) {
    other.stage = stage;
    programs.chooseStage(other);
    static_cast<void>(programs.shaded(true));
    for (const BackdropShows shown : {BackdropShows::ground, BackdropShows::beyond})
      static_cast<void>(programs.backdropOf(shown));
  }
  other.stage = settings.stage;
  for (const std::string_view name : shadingModels) {
    other.shader = name;
    const ShadingModel model = shadingModelOf(other);
    programs.chooseModel(model);
    if (model.hasVertexLight) static_cast<void>(programs.cloth(model, ClothLight::atVertices));
    if (model.isMatte) static_cast<void>(programs.cloth(model, ClothLight::plain));
    for (const bool withCuts : {false, true}) static_cast<void>(programs.normals(withCuts));
    static_cast<void>(programs.meshNormals());
    static_cast<void>(programs.smooth());
    static_cast<void>(programs.layers());
    static_cast<void>(programs.cloth(model, ClothLight::exposed));
    const ShadingModel thick = shadingModelOf(other, true);
    programs.chooseModel(thick);
    static_cast<void>(programs.cloth(thick, ClothLight::exposed));
    if (name == "fabric")
      for (const ClothLight light : {ClothLight::atPixels, ClothLight::exposed})
        static_cast<void>(programs.fuzz(thick, light));
  }
  for (const bool ofLean : {false, true}) static_cast<void>(programs.rim(ofLean));
  static_cast<void>(programs.diagonals());
  static_cast<void>(programs.picking());
  static_cast<void>(programs.overlays());
  static_cast<void>(programs.edges());
  static_cast<void>(programs.mean());
}

}  // namespace clothsim
