// What the renderer holds between pictures, and the passes of a picture.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "render/changed_area.h"
#include "render/cloth_mesh.h"
#include "render/colliders.h"
#include "render/edges.h"
#include "render/exposure.h"
#include "render/model_textures.h"
#include "render/piece_looks.h"
#include "render/programs.h"
#include "render/renderer.h"
#include "render/shadow_map.h"
#include "render/smooth_surface.h"
#include "render/stage.h"
#include "render/stretch.h"

namespace clothsim {

struct Renderer::Parts {
  struct Picture {
    GLuint positions;
    const Camera* camera;
    double time;
    GLuint target;
    int width, height;
    const gl::Framebuffer* over = nullptr;  // the target, whose top row comes first and that keeps its pixels
    const Exposure* exposure = nullptr;     // of a mean; none: the whole picture
    int number = 0;                         // of the exposure
  };

  Parts(const Shared<Cloth>& drawn, const Shared<Scene>& first, const RenderOptions& wanted);

  void configure(const Shared<Scene>& edited);
  // The passes of a picture in their order, each through around(name, pass).
  using Around = std::function<void(const char*, const std::function<void()>&)>;
  void draw(const Picture& picture, const Around& around);
  [[nodiscard]] bool isExposed() const { return frame.toSky[0].w > 0; }  // for a mean (render/exposure.h)
  void setOptions(const RenderOptions& wanted);
  void lookFrom(const Camera& camera, int width, int height, double aspect);
  void shineFrom(const Exposure* exposure);
  void lookThrough(const Exposure& exposure, const Camera& camera);
  void addToMean(bool isFirst);
  void uploadFrame();
  GLuint moved(GLuint positions);
  // The last pass that writes the picture: the resolve into the target; the stretch into the target, which
  // also turns the rows around (Renderer::drawOver); or the stretch into a framebuffer of ours.
  [[nodiscard]] bool isDirect() const { return scale >= 1 && !isOver() && !options.keepsStill; }
  [[nodiscard]] bool isOver() const { return drawnOver.texture != 0; }
  [[nodiscard]] bool stretchesApart() const { return scale < 1 && !isOver(); }
  void makeTargets(int width, int height, int shownWidth, int shownHeight);
  void findChanges(GLuint positions, int width, int height);
  void scissor() const;
  void chooseSurface(const Camera& camera, int height, double aspect);
  void computeNormals(GLuint positions);
  // `choose` binds the program for a look; its textures and its block are bound before.
  void drawSurface(GLuint positions, const std::function<void(const PieceLook&)>& choose,
                   bool meshesAsLines = false);
  void drawPieces(GLuint positions, bool smoothly, bool meshesAsLines, std::optional<std::size_t> only);
  [[nodiscard]] bool drawsThick() const { return frame.thickness > 0; }
  void drawShadows(GLuint positions);
  void drawCasters(GLuint positions);
  [[nodiscard]] bool castsCoarsely() const;
  void drawSkyShadows(GLuint positions);
  void drawScene(GLuint positions);
  void drawPlanes(const gl::Program& program);
  [[nodiscard]] bool isGroundBehind(const PlaneDisc& plane) const;
  void drawCloth(GLuint positions);
  [[nodiscard]] ClothLight lightOf(const PieceLook& look) const;
  [[nodiscard]] bool isLitAtVertices() const;  // all cloth
  void drawOverlay(GLuint positions);
  void drawFuzz(GLuint positions);          // in fuzz.cpp
  [[nodiscard]] float longestFuzz() const;  // [m]
  void drawIdentities(GLuint positions);
  void drawBackdrop(int width, int height);
  void resolveInto(GLuint destination, int width, int height, const gl::Program& resolve, GLuint texture);
  void finishInto(GLuint destination, int width, int height);  // from the canvas
  void layBackdrop();
  [[nodiscard]] PixelRect drawnPart() const;  // of the canvas
  void show(GLuint destination, int width, int height) const;
  void stretch();

  Shared<Cloth> cloth;
  Cuts cuts;
  RenderOptions options;
  ViewOptions view;
  ClothOutline outline;
  Shared<Scene> scene;
  Stage stage;
  float lowestFloor = std::numeric_limits<float>::infinity();  // of all scenes so far [m]
  std::vector<PieceLook> looks;                                // at least one; several: one for each piece
  ShadingModel model;                                          // of the first
  shared::RenderFrame frame{};

  RenderPrograms programs;
  ModelTextures textures;
  bool isSoftware;  // the renderer is the processor
  ClothMesh clothMesh;
  std::vector<float> thickness;         // of each piece as it is drawn [m]
  bool lightsVertices = false;          // of the cloth, which is fine enough for that
  bool isFineForPlain = false;          // the same for ClothLight::plain
  double pixelsAMetre = 0;              // at the distance of what the camera looks at
  double shellPlace = 0.5;              // of the shells of fuzz between their neighbours, 0 to 1
  std::optional<SmoothSurface> smooth;  // drawn instead of the triangles of the particles
  Colliders colliders;
  ShadowMap shadowMap;
  std::vector<ShadowMap> skyShadowMaps;  // of an exposure
  std::vector<Exposure> exposures;
  GLuint velocities = 0;
  gl::Buffer<glm::vec4> movedPositions;  // of an exposure, while the shutter is open
  gl::Framebuffer mean;                  // the sum of the exposures' light, with their number
  SpringsOverlay springs;
  std::optional<PickTarget> pickTarget;
  double scale = 1;
  struct DrawnOver {
    GLuint texture = 0;  // 0: none
    PictureSize size;
    friend bool operator==(const DrawnOver&, const DrawnOver&) = default;
  } drawnOver;  // where the last picture is
  gl::Framebuffer canvas, backdrop;
  Edges edges;
  Stretch stretcher;
  gl::Framebuffer finished, stretched;    // as the screen shows it; before and after stretching
  glm::mat4 middleClipFromWorld{1};       // of the picture, whatever its exposures shift
  std::optional<glm::mat4> backdropSeen;  // from where the backdrop was drawn
  ChangedArea changes;
  std::optional<ChangedArea::Area> part;   // of the picture that is drawn; none: all of it
  std::optional<PixelBands> underShadows;  // where the ground is drawn; none: everywhere
  gl::Buffer<shared::RenderFrame> frameBlock{"render frame", 1};
  std::vector<gl::Buffer<shared::RenderFrame>> lookBlocks;  // the same with the look of each piece
  gl::VertexArray noVertices{"no vertices"};
};

}  // namespace clothsim
