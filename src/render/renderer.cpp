#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/context.h"
#include "gl/framebuffer.h"
#include "gl/timer.h"
#include "render/cloth_mesh.h"
#include "render/colliders.h"
#include "render/look.h"
#include "render/model_textures.h"
#include "render/programs.h"
#include "render/shadow_map.h"
#include "render/stage.h"

namespace clothsim {
namespace {

constexpr GLenum backdropFormat = GL_RGB10_A2;  // its slow gradients would show steps in 8 bits
constexpr GLenum canvasFormat = GL_RGBA8;       // square roots of linear light (shaders/render/tone.glsl)

// The longest side of a triangle of cloth: the diagonal of a cell [m].
double longestEdge(const Cloth& cloth) {
  double longest = 0;
  for (const Piece& piece : cloth.pieces()) {
    if (piece.isMesh) {
      longest = std::max(longest, piece.longestEdge);
      continue;
    }
    longest = std::max(longest, std::hypot(piece.nominalLength[toLeft], piece.nominalLength[toUpper]));
  }
  return longest;
}

RenderOptions withSupportedSamples(RenderOptions options) {
  options.samples = gl::supportedSamples(options.samples);
  return options;
}

}  // namespace

struct Renderer::Parts {
  struct Picture {
    GLuint positions;
    const Camera* camera;
    double time;
    GLuint target;
    int width, height;
  };

  Parts(const Shared<Cloth>& drawn, const Shared<Scene>& first, const RenderOptions& wanted);

  void configure(const Shared<Scene>& edited);
  // The passes of a picture in their order, each through around(name, pass).
  template <class Around>
  void draw(const Picture& picture, Around around);
  void lookFrom(const Camera& camera, int width, int height);
  void uploadFrame();
  void computeNormals(GLuint positions);
  void drawShadows(GLuint positions);
  void drawScene(GLuint positions, int width, int height);
  void drawCloth(GLuint positions);
  void drawOverlay(GLuint positions);
  void drawIdentities(GLuint positions);
  void drawBackdrop(int width, int height);
  void resolveInto(GLuint destination, int width, int height);

  Shared<Cloth> cloth;
  Cuts cuts;
  RenderOptions options;
  ViewOptions view;
  ClothOutline outline;
  Shared<Scene> scene;
  Stage stage;
  ShadingModel model;
  shared::RenderFrame frame{};

  RenderPrograms programs;
  ModelTextures textures;
  ClothMesh clothMesh;
  Colliders colliders;
  ShadowMap shadowMap;
  SpringsOverlay springs;
  std::optional<PickTarget> pickTarget;
  gl::Framebuffer canvas, backdrop;
  bool backdropIsCurrent = false;
  gl::Buffer<shared::RenderFrame> frameBlock{"render frame", 1};
  gl::VertexArray noVertices{"no vertices"};
};

Renderer::Parts::Parts(const Shared<Cloth>& drawn, const Shared<Scene>& first, const RenderOptions& wanted)
    : cloth(drawn),
      options(withSupportedSamples(wanted)),
      outline(outlineOf(*cloth)),
      scene(first),
      model(shadingModelOf(first->render)),
      programs(model, first->render.background, options.samples),
      clothMesh(*cloth),
      colliders(wanted.sphereSegmentsAround, wanted.sphereSegmentsDown, longestEdge(*cloth)),
      shadowMap(wanted.shadowMapSize) {
  configure(first);
}

// What can fail comes first: after an error all is as it was.
void Renderer::Parts::configure(const Shared<Scene>& edited) {
  const ShadingModel wanted = shadingModelOf(edited->render);
  textures.choose(wanted, edited->render.background);
  if (edited->render.background != scene->render.background)
    programs.chooseBackground(edited->render.background);
  if (!(wanted == model)) programs.chooseModel(wanted);
  model = wanted;
  if (model.measuresStrain) clothMesh.keepRestPositions(*cloth);
  scene = edited;
  stage = makeStage(outline, *scene);
  colliders.build(*scene);
  frame = makeLook(scene->render, outline.front, textures.irradiance());
  shadowMap.cover(stage.reach, glm::vec3(frame.toKeyLight));
  frame.shadowFromWorld = shadowMap.shadowFromWorld();
  frame.toKeyLight.w = shadowMap.texelLength();
  backdropIsCurrent = false;
}

void Renderer::Parts::lookFrom(const Camera& camera, int width, int height) {
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  const glm::mat4 clipFromView = camera.projection(static_cast<double>(width) / height);
  const glm::mat4 worldFromView = glm::inverse(camera.view());
  frame.clipFromWorld = clipFromView * camera.view();
  frame.eye = glm::vec4(camera.eye(), 0);
  frame.pixels = {w, h, 1 / w, 1 / h};
  frame.rayMiddle = -worldFromView[2];
  frame.rayRight = worldFromView[0] / clipFromView[0][0];
  frame.rayUp = worldFromView[1] / clipFromView[1][1];
}

void Renderer::Parts::uploadFrame() {
  frameBlock.upload(std::span(&frame, 1));
  frameBlock.bindUniform(RENDER_FRAME_BINDING);
}

void Renderer::Parts::computeNormals(GLuint positions) {
  clothMesh.computeNormals(
      {programs.normals(clothMesh.hasCuts()), cloth->hasMesh() ? &programs.meshNormals() : nullptr},
      positions);
}

void Renderer::Parts::drawShadows(GLuint positions) {
  shadowMap.begin();
  if (options.shadows) {
    programs.clothShadow.bind();
    clothMesh.draw(positions);
    // A solid's far side alone: its near side would shade itself by rounding.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    colliders.drawSolids(programs.sphereShadow, programs.shapeShadow);
    glDisable(GL_CULL_FACE);
  }
  shadowMap.end();
  shadowMap.blurForFloors(programs);
}

// Front to back as far as the order is known, so that hidden fragments are not shaded; what blends comes
// last.
void Renderer::Parts::drawScene(GLuint positions, int width, int height) {
  const gl::FramebufferFormat format{width, height, options.samples, canvasFormat, GL_DEPTH_COMPONENT24};
  if (!(canvas.format() == format)) canvas = gl::Framebuffer("canvas", format);
  canvas.bind();
  shadowMap.bindTextures();
  const float farthest = 1;
  glClearNamedFramebufferfv(canvas.name(), GL_DEPTH, 0, &farthest);
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(BACKDROP_UNIT, backdrop.colorTexture());
  programs.layBackdrop.bind();
  noVertices.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);

  if (!model.blends) drawCloth(positions);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  colliders.drawSolids(programs.sphere, programs.shape);
  glDisable(GL_CULL_FACE);

  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  colliders.drawPlanes(programs.plane);
  if (model.blends) drawCloth(positions);
  drawOverlay(positions);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void Renderer::Parts::drawCloth(GLuint positions) {
  if (!model.blends) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    programs.clothDepth.bind();
    clothMesh.draw(positions);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  programs.cloth.bind();
  clothMesh.draw(positions, model.name == "wireframe");  // whose lines are otherwise those of a grid
}

void Renderer::Parts::drawOverlay(GLuint positions) {
  if (view == ViewOptions{}) return;
  springs.draw(view, programs.overlays(), *cloth, cuts, positions);
}

void Renderer::Parts::drawIdentities(GLuint positions) {
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);  // the solver's last positions
  const PickPrograms& picking = programs.picking();
  picking.cloth.bind();
  clothMesh.draw(positions);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  colliders.drawSolids(picking.sphere, picking.shape);
  colliders.drawPlanes(picking.plane);
  glDisable(GL_CULL_FACE);
}

// Only the sky turns with the camera; others are drawn once.
void Renderer::Parts::drawBackdrop(int width, int height) {
  const gl::FramebufferFormat format{.width = width, .height = height, .color = backdropFormat};
  if (backdropIsCurrent && backdrop.format() == format && scene->render.background != "sky") return;
  if (!(backdrop.format() == format)) backdrop = gl::Framebuffer("backdrop", format);
  backdrop.bind();
  glDisable(GL_DEPTH_TEST);
  programs.backdrop.bind();
  noVertices.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  backdropIsCurrent = true;
}

void Renderer::Parts::resolveInto(GLuint destination, int width, int height) {
  glDisable(GL_FRAMEBUFFER_SRGB);  // the shader encodes
  glBindFramebuffer(GL_FRAMEBUFFER, destination);
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(CANVAS_UNIT, canvas.colorTexture());
  programs.resolve.bind();
  noVertices.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Renderer::Renderer(const Shared<Cloth>& cloth, const Shared<Scene>& scene, const RenderOptions& options)
    : parts_(std::make_unique<Parts>(cloth, scene, options)) {}

Renderer::~Renderer() = default;

void Renderer::configure(const Shared<Scene>& scene) { parts_->configure(scene); }

void Renderer::setView(const ViewOptions& view) { parts_->view = view; }

void Renderer::setCuts(const Cuts& cuts) {
  parts_->cuts = cuts;
  parts_->clothMesh.setCuts(*parts_->cloth, cuts);
  parts_->springs.forgetCuts();
}

std::optional<std::string> Renderer::reloadShaders() {
  try {
    tryAllShaders(parts_->scene->render, parts_->options.samples);
    parts_->programs =
        RenderPrograms(parts_->model, parts_->scene->render.background, parts_->options.samples);
    parts_->backdropIsCurrent = false;
    return std::nullopt;
  } catch (const Error& error) {
    return error.what();
  }
}

double Renderer::strainAt(std::uint32_t particle) const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const float strain = parts_->clothMesh.tangents().download(particle, 1).front().w;
  return static_cast<double>(strain);
}

Pick Renderer::pick(GLuint positions, const Camera& camera, double time, int width, int height, double x,
                    double y) {
  if (width <= 0 || height <= 0) return {};
  Parts& parts = *parts_;
  if (!parts.pickTarget) parts.pickTarget.emplace();
  parts.colliders.place(*parts.scene, parts.stage, time);
  parts.lookFrom(camera, width, height);
  const glm::mat4 clipFromWorld = parts.frame.clipFromWorld;
  parts.frame.clipFromWorld = PickTarget::clipFromPicture(width, height, x, y) * clipFromWorld;
  parts.uploadFrame();
  parts.pickTarget->begin();
  parts.drawIdentities(positions);
  parts.pickTarget->end();
  const glm::vec2 ndc{2 * x / width - 1, 1 - 2 * y / height};
  return parts.pickTarget->read(parts.cloth->pieces(), clipFromWorld, ndc, camera.eye());
}

template <class Around>
void Renderer::Parts::draw(const Picture& picture, Around around) {
  const auto [positions, camera, time, target, width, height] = picture;
  if (width <= 0 || height <= 0) return;  // a minimised window
  colliders.place(*scene, stage, time);
  lookFrom(*camera, width, height);
  uploadFrame();
  textures.bind();
  around("normals", [&, p = positions] { computeNormals(p); });
  around("shadows", [&, p = positions] { drawShadows(p); });
  around("backdrop", [&, w = width, h = height] { drawBackdrop(w, h); });
  around("scene", [&, p = positions, w = width, h = height] { drawScene(p, w, h); });
  around("resolve", [&, t = target, w = width, h = height] { resolveInto(t, w, h); });
}

void Renderer::draw(GLuint positions, const Camera& camera, double time, GLuint target, int width,
                    int height) {
  parts_->draw({positions, &camera, time, target, width, height},
               [](const char*, const auto& pass) { pass(); });
}

std::vector<DrawTime> Renderer::timeDraw(GLuint positions, const Camera& camera, double time, GLuint target,
                                         int width, int height) {
  std::vector<DrawTime> times;
  gl::Timer timer;
  parts_->draw({positions, &camera, time, target, width, height}, [&](const char* name, const auto& pass) {
    timer.begin();
    pass();
    timer.end();
    times.push_back({name, timer.seconds()});
  });
  return times;
}

Image renderImage(Renderer& renderer, GLuint positions, const Camera& camera, double time, int width,
                  int height) {
  const gl::Framebuffer picture("picture", {.width = width, .height = height, .color = GL_RGBA8});
  renderer.draw(positions, camera, time, picture.name(), width, height);
  Image image{width, height, picture.readRgb()};
  gl::checkContext();  // what it has read would be nothing
  return image;
}

}  // namespace clothsim
