#include "render/exposure.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "core/hash.h"

namespace clothsim {
namespace {

constexpr double TWO_PI = 2 * std::numbers::pi;

// Points of the unit square in an order drawn by lot.
std::vector<glm::dvec2> spread(int count, std::uint32_t seed) {
  const double plastic = 1.32471795724474602596;  // x^3 = x + 1
  std::vector<glm::dvec2> points;
  for (int n = 0; n < count; ++n) {
    const auto part = [&](double step) { return std::fmod(0.5 + (n + 1) / step, 1.0); };
    points.emplace_back(part(plastic), part(plastic * plastic));
  }
  for (std::size_t left = points.size(); left > 1; --left) {
    const auto drawn = static_cast<std::size_t>(uniform01(seed, static_cast<std::uint32_t>(left)) *
                                                static_cast<double>(left));
    std::swap(points[left - 1], points[drawn]);
  }
  return points;
}

double inTent(double u) { return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

glm::vec2 inDisc(glm::dvec2 u) {
  return glm::vec2(std::sqrt(u.x) * glm::dvec2(std::cos(TWO_PI * u.y), std::sin(TWO_PI * u.y)));
}

glm::vec3 onSphere(glm::dvec2 u) {
  const double y = 1 - 2 * u.x, around = std::sqrt(1 - y * y);
  return glm::vec3(around * std::cos(TWO_PI * u.y), y, around * std::sin(TWO_PI * u.y));
}

}  // namespace

std::vector<Exposure> makeExposures(int count) {
  const auto pixels = spread(count, 1), lenses = spread(count, 2), lights = spread(count, 3),
             times = spread(count, 5), skies = spread(SKY_DIRECTIONS * count, 4);
  std::vector<Exposure> exposures;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    Exposure exposure{glm::vec2(inTent(pixels[n].x), inTent(pixels[n].y)),
                      inDisc(lenses[n]),
                      inDisc(lights[n]),
                      {},
                      times[n].x - 0.5};
    for (std::size_t k = 0; k < SKY_DIRECTIONS; ++k)
      exposure.sky[k] = onSphere(skies[SKY_DIRECTIONS * n + k]);
    exposures.push_back(exposure);
  }
  return exposures;
}

glm::vec3 directionToLight(const Exposure& exposure, glm::vec3 toLight, double degrees) {
  const glm::vec3 side = std::abs(toLight.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 across = glm::normalize(glm::cross(toLight, side)), along = glm::cross(toLight, across);
  const auto radius = static_cast<float>(std::tan(degrees * std::numbers::pi / 360));
  return glm::normalize(toLight + radius * (exposure.light.x * across + exposure.light.y * along));
}

glm::mat4 viewThroughLens(const Exposure& exposure, double aperture, double focus) {
  const glm::vec2 aside = static_cast<float>(0.5 * aperture) * exposure.lens;
  glm::mat4 moved(1);
  moved[3] = glm::vec4(-aside, 0, 1);
  moved[2] = glm::vec4(-aside / static_cast<float>(focus), 1, 0);
  return moved;
}

}  // namespace clothsim
