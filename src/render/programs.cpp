#include "render/programs.h"

#include <utility>

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
  return gl::Program::makeRender(vertexFile, "render/depth_only.frag", defines);
}

}  // namespace

RenderPrograms::RenderPrograms(const ShadingModel& model, const std::string& background, int samples)
    : layBackdrop(gl::Program::makeRender("render/fullscreen.vert", "render/backdrop.frag", {{"LAY", ""}})) {
  chooseSamples(samples);
  chooseModel(model);
  chooseBackground(background);
}

MeanPrograms::MeanPrograms(int samples)
    : add(gl::Program::makeRender("render/fullscreen.vert", "render/resolve.frag",
                                  {{"SAMPLES", std::to_string(samples)}, {"ADDS", ""}})) {}

void RenderPrograms::chooseSamples(int samples) {
  resolve = gl::Program::makeRender("render/fullscreen.vert", "render/resolve.frag",
                                    {{"SAMPLES", std::to_string(samples)}});
  samples_ = samples;
  mean_.reset();
}

void RenderPrograms::chooseModel(const ShadingModel& model) {
  gl::Program shading = makeShading(model);
  gl::Program depth = makeDepthOnly("render/cloth_depth.vert", model);
  clothShadow = makeDepthOnly("render/cloth_shadow.vert", model);
  clothDepth = std::move(depth);
  cloth = std::move(shading);
  if (std::exchange(measuresStrain_, model.measuresStrain) == model.measuresStrain) return;
  normals_.reset();
  normalsWithCuts_.reset();
  meshNormals_.reset();
}

void RenderPrograms::chooseBackground(const std::string& background) {
  gl::Defines defines;
  if (background == "sky") defines.emplace_back("SKY", "");
  if (background == "plain") defines.emplace_back("PLAIN", "");
  backdrop = gl::Program::makeRender("render/fullscreen.vert", "render/backdrop.frag", defines);
}

const gl::Program& RenderPrograms::normals(bool withCuts) {
  auto& program = withCuts ? normalsWithCuts_ : normals_;
  if (!program) program.emplace(makeNormals(withCuts, measuresStrain_));
  return *program;
}

const gl::Program& RenderPrograms::meshNormals() {
  if (!meshNormals_)
    meshNormals_.emplace(gl::Program::makeCompute(
        "render/mesh_normals.comp", measuresStrain_ ? gl::Defines{{"STRAIN", ""}} : gl::Defines{}));
  return *meshNormals_;
}

const SmoothPrograms& RenderPrograms::smooth() {
  if (!smooth_) smooth_.emplace();
  return *smooth_;
}

const PickPrograms& RenderPrograms::picking() {
  if (!picking_) picking_.emplace();
  return *picking_;
}

const OverlayPrograms& RenderPrograms::overlays() {
  if (!overlays_) overlays_.emplace();
  return *overlays_;
}

const MeanPrograms& RenderPrograms::mean() {
  if (!mean_) mean_.emplace(samples_);
  return *mean_;
}

void tryAllShaders(const RenderSettings& settings, int samples) {
  RenderSettings other = settings;
  RenderPrograms programs(shadingModelOf(other), settings.background, samples);
  for (const std::string_view background : backgrounds) programs.chooseBackground(std::string(background));
  for (const std::string_view name : shadingModels) {
    other.shader = name;
    programs.chooseModel(shadingModelOf(other));
    for (const bool withCuts : {false, true}) static_cast<void>(programs.normals(withCuts));
    static_cast<void>(programs.meshNormals());
    static_cast<void>(programs.smooth());
  }
  static_cast<void>(programs.picking());
  static_cast<void>(programs.overlays());
  static_cast<void>(programs.mean());
}

}  // namespace clothsim
