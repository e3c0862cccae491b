#include "render/renderer.h"

#include <algorithm>

#include "core/error.h"
#include "gl/context.h"
#include "gl/timer.h"
#include "render/renderer_parts.h"

namespace clothsim {

Renderer::Renderer(const Shared<Cloth>& cloth, const Shared<Scene>& scene, const RenderOptions& options)
    : parts_(std::make_unique<Parts>(cloth, scene, options)) {}

Renderer::~Renderer() = default;

void Renderer::configure(const Shared<Scene>& scene) { parts_->configure(scene); }

void Renderer::setView(const ViewOptions& view) {
  parts_->view = view;
  parts_->changes.forget();
}

void Renderer::setOptions(const RenderOptions& options) { parts_->setOptions(options); }

void Renderer::setScale(double scale) { parts_->scale = std::clamp(scale, 0.1, 1.0); }

void Renderer::setCuts(const Cuts& cuts) {
  parts_->cuts = cuts;
  parts_->clothMesh.setCuts(*parts_->cloth, cuts);
  parts_->smooth.reset();
  parts_->springs.forgetCuts();
  parts_->changes.forget();
}

std::optional<std::string> Renderer::reloadShaders() {
  try {
    tryAllShaders(parts_->scene->render, parts_->options.samples);
    parts_->programs = RenderPrograms(parts_->model, parts_->scene->render, parts_->options.samples);
    parts_->backdropSeen.reset();
    parts_->changes.forget();
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
  parts.lookFrom(camera, width, height, static_cast<double>(width) / height);
  const glm::mat4 clipFromWorld = parts.frame.clipFromWorld;
  parts.frame.clipFromWorld = PickTarget::clipFromPicture(width, height, x, y) * clipFromWorld;
  parts.uploadFrame();
  parts.pickTarget->begin();
  parts.drawIdentities(positions);
  parts.pickTarget->end();
  const glm::vec2 ndc{2 * x / width - 1, 1 - 2 * y / height};
  return parts.pickTarget->read(parts.cloth->pieces(), clipFromWorld, ndc, camera.eye());
}

void Renderer::draw(GLuint positions, const Camera& camera, double time, GLuint target, int width,
                    int height) {
  parts_->draw({positions, &camera, time, target, width, height},
               [](const char*, const auto& pass) { pass(); });
}

void Renderer::drawOver(GLuint positions, const Camera& camera, double time, const gl::Framebuffer& target) {
  const gl::FramebufferFormat& format = target.format();
  parts_->draw({positions, &camera, time, target.name(), format.width, format.height, &target},
               [](const char*, const auto& pass) { pass(); });
}

void Renderer::expose(int number, int count, GLuint positions, const Camera& camera, double time,
                      GLuint target, int width, int height) {
  if (parts_->exposures.size() != static_cast<std::size_t>(count)) parts_->exposures = makeExposures(count);
  const Exposure& exposure = parts_->exposures[static_cast<std::size_t>(number)];
  parts_->draw({positions, &camera, time, target, width, height, nullptr, &exposure, number},
               [](const char*, const auto& pass) { pass(); });
}

void Renderer::setVelocities(GLuint velocities) { parts_->velocities = velocities; }

void Renderer::showMean(GLuint target, int width, int height) {
  parts_->resolveInto(target, width, height, parts_->programs.mean().show, parts_->mean.colorTexture());
}

std::vector<DrawTime> Renderer::timeDraw(GLuint positions, const Camera& camera, double time, GLuint target,
                                         int width, int height) {
  std::vector<DrawTime> times;
  gl::Timer timer;
  parts_->draw({positions, &camera, time, target, width, height}, [&](const char* name, const auto& pass) {
    timer.begin();
    pass();
    timer.end();
    times.push_back({name, 0});
  });
  const std::vector<double> seconds = timer.takeSeconds();
  for (std::size_t i = 0; i < times.size(); ++i) times[i].seconds = seconds[i];
  return times;
}

Image renderImage(Renderer& renderer, GLuint positions, const Camera& camera, double time, int width,
                  int height, int exposures, const std::function<void(int)>& before) {
  const gl::Framebuffer picture("picture", {.width = width, .height = height, .color = GL_RGBA8});
  if (exposures == 1)
    renderer.draw(positions, camera, time, picture.name(), width, height);
  else
    for (int number = 0; number < exposures; ++number) {
      if (before) before(number);
      renderer.expose(number, exposures, positions, camera, time, picture.name(), width, height);
    }
  Image image{width, height, picture.readRgb()};
  gl::checkContext();  // what it has read would be nothing
  return image;
}

}  // namespace clothsim
