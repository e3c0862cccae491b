#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "render/cloth_mesh.h"
#include "render/collider_meshes.h"
#include "render/look.h"
#include "render/programs.h"
#include "render/shadow_map.h"
#include "render/shape_meshes.h"
#include "render/stage.h"

namespace clothsim {
namespace {

constexpr GLenum canvasFormat = GL_RGBA8;  // square roots of linear light (shaders/render/tone.glsl)
constexpr float floorRadius = 4.5f;        // of the stage's size: where planes have faded out

// The longest side of a triangle of cloth: the diagonal of a cell [m].
double longestEdge(const Cloth& cloth) {
  double longest = 0;
  for (const Grid& grid : cloth.grids()) {
    longest = std::max(longest, std::hypot(grid.nominalLength[toLeft], grid.nominalLength[toUpper]));
  }
  return longest;
}

bool isHorizontal(const Collider& collider) {
  const auto* plane = std::get_if<Plane>(&collider);
  return plane != nullptr && std::abs(glm::normalize(toGlm(plane->normal)).y) > 0.95f;
}

RenderOptions withSupportedSamples(RenderOptions options) {
  options.samples = gl::supportedSamples(options.samples);
  return options;
}

}  // namespace

struct Renderer::Parts {
  Parts(const Cloth& drawn, const Scene& first, const RenderOptions& wanted);

  void configure(const Scene& edited);
  void placeColliders(double time);
  void uploadFrame();
  void updateFrame(const Camera& camera, int width, int height);
  void drawShadows(GLuint positions);
  void drawScene(GLuint positions, int width, int height);
  void drawIdentities(GLuint positions);
  void resolveInto(GLuint destination, int width, int height);

  Cloth cloth;
  Cuts cuts;
  RenderOptions options;
  ClothOutline outline;
  double edge;  // longest of the cloth's triangles [m]
  Scene scene;
  Stage stage;
  ViewOptions view;
  shared::RenderFrame frame{};

  RenderPrograms programs;
  std::string shaderName;  // of programs.cloth
  std::optional<PickPrograms> pickPrograms;
  std::optional<OverlayPrograms> overlayPrograms;
  ClothMesh clothMesh;
  SpringsOverlay overlay;
  SphereMesh spheres;
  ShapeMeshes shapes;
  PlaneMesh planes;
  ShadowMap shadowMap;
  gl::Framebuffer canvas;
  gl::Buffer<shared::RenderFrame> frameBlock{"render frame", 1};
  gl::VertexArray noVertices{"no vertices"};

  std::optional<PickTarget> pickTarget;
};

Renderer::Parts::Parts(const Cloth& drawn, const Scene& first, const RenderOptions& wanted)
    : cloth(drawn),
      options(withSupportedSamples(wanted)),
      outline(outlineOf(cloth)),
      edge(longestEdge(cloth)),
      programs(first.render.shader, options.samples),
      shaderName(first.render.shader),
      clothMesh(cloth),
      spheres(wanted.sphereSegmentsAround, wanted.sphereSegmentsDown),
      shadowMap(wanted.shadowMapSize) {
  configure(first);
}

void Renderer::Parts::configure(const Scene& edited) {
  scene = edited;
  stage = makeStage(outline, scene);
  shapes.build(scene.colliders, edge);
  frame = makeLook(scene.render, outline.front);
  shadowMap.cover(stage.reach, glm::vec3(frame.toKeyLight));
  frame.shadowFromWorld = shadowMap.shadowFromWorld();
  frame.toKeyLight.w = shadowMap.texelLength();
  if (scene.render.shader != shaderName) {
    programs.cloth = makeShadingModel(scene.render.shader);
    shaderName = scene.render.shader;
  }
}

void Renderer::Parts::placeColliders(double time) {
  std::vector<SpherePlace> places;
  std::vector<PlaneDisc> discs;
  const glm::vec3 middle = stage.view.center();
  const float radius = floorRadius * glm::length(stage.view.size());
  const auto addDisc = [&](glm::vec3 point, glm::vec3 normal, float collider) {
    const glm::vec3 center = middle - glm::dot(middle - point, normal) * normal;
    discs.push_back({glm::vec4(center, radius), glm::vec4(normal, collider)});
  };
  bool hasFloor = false;
  for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
    const Collider& collider = scene.colliders[i];
    const auto number = static_cast<float>(i);
    const Pose pose = poseAt(collider, time);
    if (const auto* sphere = std::get_if<Sphere>(&collider)) {
      const double drawn = sphere->radius - sphereShrink(sphere->radius, edge);
      places.push_back({glm::vec4(toGlm(pose.position), static_cast<float>(drawn)), glm::vec4(number)});
    } else if (const auto* plane = std::get_if<Plane>(&collider)) {
      addDisc(toGlm(pose.position), glm::normalize(toGlm(rotate(pose.rotation, plane->normal))), number);
      hasFloor = hasFloor || isHorizontal(collider);
    }
  }
  if (scene.render.ground && !hasFloor) addDisc({middle.x, stage.floorHeight, middle.z}, {0, 1, 0}, -1);
  spheres.place(places);
  shapes.place(scene.colliders, time);
  planes.place(discs);
}

void Renderer::Parts::updateFrame(const Camera& camera, int width, int height) {
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  frame.clipFromWorld = camera.projection(static_cast<double>(width) / height) * camera.view();
  frame.eye = glm::vec4(camera.eye(), 0);
  frame.pixels = {w, h, 1 / w, 1 / h};
  uploadFrame();
}

void Renderer::Parts::uploadFrame() {
  frameBlock.upload(std::span(&frame, 1));
  frameBlock.bindUniform(RENDER_FRAME_BINDING);
}

void Renderer::Parts::drawShadows(GLuint positions) {
  shadowMap.begin();
  if (options.shadows) {
    programs.clothShadow.bind();
    clothMesh.draw(positions);
    // A solid's far side alone: its near side would shade itself by rounding.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    programs.sphereShadow.bind();
    spheres.draw();
    programs.shapeShadow.bind();
    shapes.draw();
    glDisable(GL_CULL_FACE);
  }
  shadowMap.end();
  shadowMap.blurForFloors(programs);
}

// Front to back as far as the order is known, so that hidden fragments are not shaded; planes last, since
// they blend.
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

  programs.cloth.bind();
  clothMesh.draw(positions);

  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  programs.sphere.bind();
  spheres.draw();
  programs.shape.bind();
  shapes.draw();
  glDisable(GL_CULL_FACE);

  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  programs.plane.bind();
  planes.draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);

  if (view == ViewOptions{}) return;
  if (!overlayPrograms) overlayPrograms.emplace();
  overlay.draw(view, *overlayPrograms, cloth, cuts, positions);
}

void Renderer::Parts::drawIdentities(GLuint positions) {
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);  // the solver's last positions
  pickPrograms->cloth.bind();
  clothMesh.draw(positions);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  pickPrograms->sphere.bind();
  spheres.draw();
  pickPrograms->shape.bind();
  shapes.draw();
  pickPrograms->plane.bind();
  planes.draw();
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
  parts_->overlay.forgetCuts();
}

std::optional<std::string> Renderer::reloadShaders() {
  try {
    RenderPrograms fresh(parts_->shaderName, parts_->options.samples);
    PickPrograms freshPick;
    OverlayPrograms freshOverlay;
    for (const std::string& name : shadingModelNames()) static_cast<void>(makeShadingModel(name));
    parts_->programs = std::move(fresh);
    parts_->pickPrograms = std::move(freshPick);
    parts_->overlayPrograms = std::move(freshOverlay);
    return std::nullopt;
  } catch (const Error& error) {
    return error.what();
  }
}

Pick Renderer::pick(GLuint positions, const Camera& camera, double time, int width, int height, double x,
                    double y) {
  if (width <= 0 || height <= 0) return {};
  if (!parts_->pickPrograms) parts_->pickPrograms.emplace();
  if (!parts_->pickTarget) parts_->pickTarget.emplace();
  parts_->placeColliders(time);
  const glm::mat4 clipFromWorld = camera.projection(static_cast<double>(width) / height) * camera.view();
  parts_->frame.clipFromWorld = PickTarget::clipFromPicture(width, height, x, y) * clipFromWorld;
  parts_->frame.eye = glm::vec4(camera.eye(), 0);
  parts_->uploadFrame();
  parts_->pickTarget->begin();
  parts_->drawIdentities(positions);
  parts_->pickTarget->end();
  const glm::vec2 ndc{2 * x / width - 1, 1 - 2 * y / height};
  return parts_->pickTarget->read(parts_->cloth.grids(), clipFromWorld, ndc, camera.eye());
}

void Renderer::draw(GLuint positions, const Camera& camera, double time, GLuint target, int width,
                    int height) {
  if (width <= 0 || height <= 0) return;  // a minimised window
  parts_->placeColliders(time);
  parts_->updateFrame(camera, width, height);
  parts_->clothMesh.computeNormals(
      parts_->clothMesh.hasCuts() ? parts_->programs.normalsWithCuts : parts_->programs.normals, positions);
  parts_->drawShadows(positions);
  parts_->drawScene(positions, width, height);
  parts_->resolveInto(target, width, height);
}

Image renderImage(Renderer& renderer, GLuint positions, const Camera& camera, double time, int width,
                  int height) {
  const gl::Framebuffer picture("picture", {.width = width, .height = height, .color = GL_RGBA8});
  renderer.draw(positions, camera, time, picture.name(), width, height);
  return {width, height, picture.readRgb()};
}

}  // namespace clothsim
