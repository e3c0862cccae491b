#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "render/cloth_mesh.h"
#include "render/collider_meshes.h"
#include "render/look.h"
#include "render/shading_models.h"
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

}  // namespace

struct Renderer::Parts {
  Parts(const Cloth& cloth, const RenderOptions& wanted);

  void configure(const Scene& edited);
  void placeColliders(double time);
  void updateFrame(const Camera& camera, int width, int height);
  void drawShadows(GLuint positions);
  void drawScene(GLuint positions, int width, int height);
  void resolveInto(GLuint destination, int width, int height);

  RenderOptions options;
  ClothOutline outline;
  double edge;  // longest of the cloth's triangles [m]
  Scene scene;
  Stage stage;
  shared::RenderFrame frame{};

  ClothMesh clothMesh;
  SphereMesh spheres;
  ShapeMeshes shapes;
  PlaneMesh planes;
  ShadowMap shadowMap;
  gl::Framebuffer canvas;
  gl::Buffer<shared::RenderFrame> frameBlock{"render frame", 1};
  gl::VertexArray noVertices{"no vertices"};

  std::string shaderName;
  gl::Program clothShading;
  gl::Program sphereShading = gl::Program::makeRender("render/sphere.vert", "render/sphere.frag");
  gl::Program shapeShading = gl::Program::makeRender("render/shape.vert", "render/sphere.frag");
  gl::Program planeShading = gl::Program::makeRender("render/plane.vert", "render/plane.frag");
  gl::Program clothShadow = gl::Program::makeRender("render/cloth_shadow.vert", "render/depth_only.frag");
  gl::Program sphereShadow = gl::Program::makeRender("render/sphere_shadow.vert", "render/depth_only.frag");
  gl::Program shapeShadow = gl::Program::makeRender("render/shape_shadow.vert", "render/depth_only.frag");
  gl::Program resolve;
};

Renderer::Parts::Parts(const Cloth& cloth, const RenderOptions& wanted)
    : options(wanted),
      outline(outlineOf(cloth)),
      edge(longestEdge(cloth)),
      clothMesh(cloth),
      spheres(wanted.sphereSegmentsAround, wanted.sphereSegmentsDown),
      shadowMap(wanted.shadowMapSize) {
  options.samples = gl::supportedSamples(wanted.samples);
  resolve = gl::Program::makeRender("render/fullscreen.vert", "render/resolve.frag",
                                    {{"SAMPLES", std::to_string(options.samples)}});
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
    clothShading = makeShadingModel(scene.render.shader);
    shaderName = scene.render.shader;
  }
}

void Renderer::Parts::placeColliders(double time) {
  std::vector<glm::vec4> places;
  std::vector<PlaneDisc> discs;
  const glm::vec3 middle = stage.view.center();
  const float radius = floorRadius * glm::length(stage.view.size());
  const auto addDisc = [&](glm::vec3 point, glm::vec3 normal) {
    const glm::vec3 center = middle - glm::dot(middle - point, normal) * normal;
    discs.push_back({glm::vec4(center, radius), glm::vec4(normal, 0)});
  };
  bool hasFloor = false;
  for (const Collider& collider : scene.colliders) {
    const Pose pose = poseAt(collider, time);
    if (const auto* sphere = std::get_if<Sphere>(&collider)) {
      const double drawn = sphere->radius - sphereShrink(sphere->radius, edge);
      places.emplace_back(toGlm(pose.position), static_cast<float>(drawn));
    } else if (const auto* plane = std::get_if<Plane>(&collider)) {
      addDisc(toGlm(pose.position), glm::normalize(toGlm(rotate(pose.rotation, plane->normal))));
      hasFloor = hasFloor || isHorizontal(collider);
    }
  }
  if (scene.render.ground && !hasFloor) addDisc({middle.x, stage.floorHeight, middle.z}, {0, 1, 0});
  spheres.place(places);
  shapes.place(scene.colliders, time);
  planes.place(discs);
}

void Renderer::Parts::updateFrame(const Camera& camera, int width, int height) {
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  frame.clipFromWorld = camera.projection(static_cast<double>(width) / height) * camera.view();
  frame.eye = glm::vec4(camera.eye(), 0);
  frame.pixels = {w, h, 1 / w, 1 / h};
  frameBlock.upload(std::span(&frame, 1));
  frameBlock.bindUniform(RENDER_FRAME_BINDING);
}

void Renderer::Parts::drawShadows(GLuint positions) {
  shadowMap.begin();
  if (options.shadows) {
    clothShadow.bind();
    clothMesh.draw(positions);
    // A solid's far side alone: its near side would shade itself by rounding.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    sphereShadow.bind();
    spheres.draw();
    shapeShadow.bind();
    shapes.draw();
    glDisable(GL_CULL_FACE);
  }
  shadowMap.end();
  shadowMap.blurForFloors();
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

  clothShading.bind();
  clothMesh.draw(positions);

  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  sphereShading.bind();
  spheres.draw();
  shapeShading.bind();
  shapes.draw();
  glDisable(GL_CULL_FACE);

  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  planeShading.bind();
  planes.draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void Renderer::Parts::resolveInto(GLuint destination, int width, int height) {
  glDisable(GL_FRAMEBUFFER_SRGB);  // the shader encodes
  glBindFramebuffer(GL_FRAMEBUFFER, destination);
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(CANVAS_UNIT, canvas.colorTexture());
  resolve.bind();
  noVertices.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Renderer::Renderer(const Cloth& cloth, const Scene& scene, const RenderOptions& options)
    : parts_(std::make_unique<Parts>(cloth, options)) {
  parts_->configure(scene);
}

Renderer::~Renderer() = default;

void Renderer::configure(const Scene& scene) { parts_->configure(scene); }

void Renderer::draw(GLuint positions, const Camera& camera, double time, GLuint target, int width,
                    int height) {
  if (width <= 0 || height <= 0) return;  // a minimised window
  parts_->placeColliders(time);
  parts_->updateFrame(camera, width, height);
  parts_->clothMesh.computeNormals(positions);
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
