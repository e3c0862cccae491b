// Small pictures for tests: a sheet draped over a ball, made by formula, and how far two pictures are apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <vector>

#include "gl/buffer.h"
#include "render/renderer.h"
#include "solver/state.h"

namespace clothsim::test {

constexpr int pictureWidth = 96, pictureHeight = 64;

struct Drape {
  Scene scene;
  Cloth cloth;
  std::vector<Particle4> positions;

  explicit Drape(const Scene& wanted) : scene(wanted), cloth(wanted) {
    for (const Vec3d& rest : cloth.positions()) positions.push_back(draped(rest));
  }

  // The unit sheet at y = 1 laid over a ball of radius 0.25 m: over the top by arc length, then down in
  // ripples.
  static Particle4 draped(Vec3d rest) {
    constexpr double radius = 0.25;
    const double x = rest.x - 0.5, z = rest.z - 0.5;
    const double length = std::sqrt(x * x + z * z), around = std::atan2(z, x);
    const double overTop = std::min(length, 1.5707963 * radius), angle = overTop / radius;
    const double hanging = length - overTop;
    const double ripple = radius * std::sin(angle) + 0.10 * hanging + 0.22 * hanging * std::cos(9 * around);
    const Vec3d p{0.5 + ripple * std::cos(around), 0.5 + radius * std::cos(angle) - hanging,
                  0.5 + ripple * std::sin(around)};
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 1};
  }
};

inline Scene drapeScene() {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 48;
  Sphere ball;
  ball.origin = {0.5, 0.5, 0.5};
  ball.radius = 0.25;
  scene.colliders.emplace_back(ball);
  scene.render.shader = "phong";
  scene.render.stage = "none";  // stages have pictures of their own
  scene.camera.position = Vec3d{1.35, 1.0, 2.0};
  scene.camera.target = Vec3d{0.55, 0.38, 0.5};
  return scene;
}

inline Image drawDrape(const Scene& scene, const RenderOptions& options = {}, int width = pictureWidth,
                       int height = pictureHeight) {
  const Drape drape(scene);
  const gl::Buffer<Particle4> positions("positions", drape.positions);
  Renderer renderer(drape.cloth, drape.scene, options);
  return renderImage(renderer, positions.name(), Camera(drape.scene, drape.cloth), 0, width, height);
}

// The mean difference of all channels, 0 to 255. Drivers disagree at edges; over the whole picture that is
// below 1.
inline double meanDifference(const Image& a, const Image& b) {
  if (a.rgb.size() != b.rgb.size()) return 255;
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    sum += std::abs(static_cast<int>(a.rgb[i]) - static_cast<int>(b.rgb[i]));
  return sum / static_cast<double>(a.rgb.size());
}

inline std::array<int, 3> pixelAt(const Image& image, int x, int y) {
  const std::size_t i = 3 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

}  // namespace clothsim::test
