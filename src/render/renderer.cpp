#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "render/cloth_mesh.h"
#include "render/colliders.h"
#include "render/look.h"
#include "render/model_textures.h"
#include "render/programs.h"
#include "render/shadow_map.h"
#include "render/stage.h"

namespace clothsim {
namespace {

constexpr GLenum canvasFormat = GL_RGBA8;  // square roots of linear light (shaders/render/tone.glsl)

// The longest side of a triangle of cloth: the diagonal of a cell [m].
double longestEdge(const Cloth& cloth) {
  double longest = 0;
  for (const Grid& grid : cloth.grids()) {
    longest = std::max(longest, std::hypot(grid.nominalLength[toLeft], grid.nominalLength[toUpper]));
  }
  return longest;
}

RenderOptions withSupportedSamples(RenderOptions options) {
  options.samples = gl::supportedSamples(options.samples);
  return options;
}

}  // namespace

struct Renderer::Parts {
  Parts(const Cloth& drawn, const Scene& first, const RenderOptions& wanted);

  void configure(const Scene& edited);
  void lookFrom(const Camera& camera, int width, int height);
  void uploadFrame();
  void computeNormals(GLuint positions);
  void drawShadows(GLuint positions);
  void drawScene(GLuint positions, int width, int height);
  void drawCloth(GLuint positions);
  void drawOverlay(GLuint positions);
  void drawIdentities(GLuint positions);
  void resolveInto(GLuint destination, int width, int height);

  Cloth cloth;
  Cuts cuts;
  RenderOptions options;
  ViewOptions view;
  ClothOutline outline;
  Scene scene;
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
  gl::Framebuffer canvas;
  gl::Buffer<shared::RenderFrame> frameBlock{"render frame", 1};
  gl::VertexArray noVertices{"no vertices"};
};

Renderer::Parts::Parts(const Cloth& drawn, const Scene& first, const RenderOptions& wanted)
    : cloth(drawn),
      options(withSupportedSamples(wanted)),
      outline(outlineOf(cloth)),
      scene(first),
      model(shadingModelOf(first.render)),
      programs(model, first.render.background, options.samples),
      clothMesh(cloth),
      colliders(wanted.sphereSegmentsAround, wanted.sphereSegmentsDown, longestEdge(cloth)),
      shadowMap(wanted.shadowMapSize) {
  configure(first);
}

// What can fail comes first: after an error all is as it was.
void Renderer::Parts::configure(const Scene& edited) {
  const ShadingModel wanted = shadingModelOf(edited.render);
  textures.choose(wanted, edited.render.background);
  if (edited.render.background != scene.render.background)
    programs.chooseBackground(edited.render.background);
  if (!(wanted == model)) programs.chooseModel(wanted);
  model = wanted;
  if (model.measuresStrain) clothMesh.keepRestPositions(cloth);
  scene = edited;
  stage = makeStage(outline, scene);
  colliders.build(scene);
  frame = makeLook(scene.render, outline.front, textures.irradiance());
  shadowMap.cover(stage.reach, glm::vec3(frame.toKeyLight));
  frame.shadowFromWorld = shadowMap.shadowFromWorld();
  frame.toKeyLight.w = shadowMap.texelLength();
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
  clothMesh.computeNormals(programs.normals(clothMesh.hasCuts()), positions);
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
  const std::array<float, 4> nothing{0, 0, 0, 0};
  glClearNamedFramebufferfv(canvas.name(), GL_COLOR, 0, nothing.data());
  glClearNamedFramebufferfv(canvas.name(), GL_DEPTH, 0, &farthest);
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
  programs.cloth.bind();
  clothMesh.draw(positions);
}

void Renderer::Parts::drawOverlay(GLuint positions) {
  if (view == ViewOptions{}) return;
  springs.draw(view, programs.overlays(), cloth, cuts, positions);
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

Renderer::Renderer(const Cloth& cloth, const Scene& scene, const RenderOptions& options)
    : parts_(std::make_unique<Parts>(cloth, scene, options)) {}

Renderer::~Renderer() = default;

void Renderer::configure(const Scene& scene) { parts_->configure(scene); }

void Renderer::setView(const ViewOptions& view) { parts_->view = view; }

void Renderer::setCuts(const Cuts& cuts) {
  parts_->cuts = cuts;
  parts_->clothMesh.setCuts(parts_->cloth, cuts);
  parts_->springs.forgetCuts();
}

std::optional<std::string> Renderer::reloadShaders() {
  try {
    tryAllShaders(parts_->scene.render, parts_->options.samples);
    parts_->programs =
        RenderPrograms(parts_->model, parts_->scene.render.background, parts_->options.samples);
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
  parts.colliders.place(parts.scene, parts.stage, time);
  parts.lookFrom(camera, width, height);
  const glm::mat4 clipFromWorld = parts.frame.clipFromWorld;
  parts.frame.clipFromWorld = PickTarget::clipFromPicture(width, height, x, y) * clipFromWorld;
  parts.uploadFrame();
  parts.pickTarget->begin();
  parts.drawIdentities(positions);
  parts.pickTarget->end();
  const glm::vec2 ndc{2 * x / width - 1, 1 - 2 * y / height};
  return parts.pickTarget->read(parts.cloth.grids(), clipFromWorld, ndc, camera.eye());
}

void Renderer::draw(GLuint positions, const Camera& camera, double time, GLuint target, int width,
                    int height) {
  if (width <= 0 || height <= 0) return;  // a minimised window
  Parts& parts = *parts_;
  parts.colliders.place(parts.scene, parts.stage, time);
  parts.lookFrom(camera, width, height);
  parts.uploadFrame();
  parts.textures.bind();
  parts.computeNormals(positions);
  parts.drawShadows(positions);
  parts.drawScene(positions, width, height);
  parts.resolveInto(target, width, height);
}

Image renderImage(Renderer& renderer, GLuint positions, const Camera& camera, double time, int width,
                  int height) {
  const gl::Framebuffer picture("picture", {.width = width, .height = height, .color = GL_RGBA8});
  renderer.draw(positions, camera, time, picture.name(), width, height);
  return {width, height, picture.readRgb()};
}

}  // namespace clothsim
