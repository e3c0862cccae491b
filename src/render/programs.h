// All programs of the renderer in one place, so that they can be made anew together while it runs.
#pragma once

#include <optional>
#include <string>

#include "gl/program.h"
#include "render/backdrop_parts.h"
#include "render/edges.h"
#include "render/shading_models.h"
#include "render/smooth_surface.h"
#include "render/springs_overlay.h"

namespace clothsim {

// Made when somebody first picks.
struct PickPrograms {
  gl::Program cloth = gl::Program::makeRender("render/pick_cloth.vert", "render/pick.frag");
  gl::Program sphere = gl::Program::makeRender("render/pick_sphere.vert", "render/pick.frag");
  gl::Program shape = gl::Program::makeRender("render/pick_shape.vert", "render/pick.frag");
  gl::Program plane = gl::Program::makeRender("render/pick_plane.vert", "render/pick.frag");
};

// What shades: solids, planes, the backdrop, and the same as a picture begins. Once for pictures that are one
// exposure, and once for exposures of a mean, which see more light and shade.
struct ShadedPrograms {
  // Defines of what stands on the stage, and of what is behind it.
  ShadedPrograms(const gl::Defines& stage, const gl::Defines& behind, bool forExposures);
  gl::Program sphere, shape, plane, backdrop, layBackdrop;
};

// Where light is worked out: at pixels; at vertices (of a model with hasVertexLight); at vertices but for
// shadows, without threads, shine and hem (of a model with isMatte); or at the pixels of exposures.
enum class ClothLight { atPixels, atVertices, plain, exposed };

// Of pictures that are the mean of exposures.
struct MeanPrograms {
  explicit MeanPrograms(int samples);
  gl::Program add;  // the canvas to the sum
  gl::Program move = gl::Program::makeCompute("render/motion.comp");
  gl::Program show = gl::Program::makeRender("render/fullscreen.vert", "render/resolve.frag",
                                             {{"SAMPLES", "1"}, {"MEAN", ""}});
};

struct RenderPrograms {
  // From the files below the resource root as they are now. @throws OpenGlError, InputOutputError
  RenderPrograms(const ShadingModel& model, const RenderSettings& settings, int samples);

  // What a scene chooses. @throws as the constructor, leaving what was there
  void chooseModel(const ShadingModel& model);
  void chooseStage(const RenderSettings& settings);  // and the background
  void chooseSamples(int samples);                   // of a pixel

  // The normals pass of the chosen model.
  [[nodiscard]] const gl::Program& normals(bool withCuts);
  [[nodiscard]] const gl::Program& meshNormals();
  [[nodiscard]] const gl::Program& diagonals();       // where light is worked out at vertices
  [[nodiscard]] const SmoothPrograms& smooth();       // the same for the smooth surface
  [[nodiscard]] const LayerPrograms& layers();        // where it has layers
  [[nodiscard]] const gl::Program& rim(bool ofLean);  // of cloth that is drawn thick
  [[nodiscard]] const PickPrograms& picking();
  [[nodiscard]] const OverlayPrograms& overlays();
  [[nodiscard]] const EdgePrograms& edges();  // of one sample a pixel
  [[nodiscard]] const MeanPrograms& mean();
  [[nodiscard]] const gl::Program& backdropOf(BackdropShows shown);  // on the canvas
  [[nodiscard]] const ShadedPrograms& shaded(bool forExposures);
  // What shades cloth, of the chosen model or one that differs from it by what it looks at.
  [[nodiscard]] const gl::Program& cloth(const ShadingModel& model, ClothLight light);
  [[nodiscard]] const gl::Program& fuzz(const ShadingModel& model, ClothLight light);  // of what it shades

  gl::Program clothDepth, clothShadow;
  gl::Program resolve;  // of several samples a pixel
  gl::Program sphereShadow = gl::Program::makeRender("render/sphere_shadow.vert", "render/depth_only.frag");
  gl::Program shapeShadow = gl::Program::makeRender("render/shape_shadow.vert", "render/depth_only.frag");
  gl::Program blurFirstAxis =
      gl::Program::makeRender("render/fullscreen.vert", "render/floor_shadow.frag", {{"FIRST_AXIS", ""}});
  gl::Program blurSecondAxis = gl::Program::makeRender("render/fullscreen.vert", "render/floor_shadow.frag");

 private:
  ShadingModel model_;
  gl::Defines stage_, behind_;
  std::optional<ShadedPrograms> shaded_, exposed_;
  std::optional<gl::Program> groundAlone_, beyondAlone_;
  std::optional<gl::Program> normals_, normalsWithCuts_, meshNormals_, diagonals_, rim_, leanRim_;
  struct ClothProgram {
    gl::Defines defines;
    ClothLight light;
    gl::Program program;
  };
  static const gl::Program& made(std::vector<ClothProgram>& programs, const ShadingModel& model,
                                 ClothLight light, const std::string& vertexFile,
                                 const std::string& fragmentFile);
  std::vector<ClothProgram> cloth_;  // of the chosen model's fragment shader
  std::vector<ClothProgram> fuzz_;
  std::optional<SmoothPrograms> smooth_;
  std::optional<LayerPrograms> layers_;
  std::optional<PickPrograms> picking_;
  std::optional<OverlayPrograms> overlays_;
  std::optional<EdgePrograms> edges_;
  std::optional<MeanPrograms> mean_;
  int samples_ = 1;
};

// Compiles all there is, for the sake of the errors. @throws OpenGlError, InputOutputError
void tryAllShaders(const RenderSettings& settings, int samples);

}  // namespace clothsim
