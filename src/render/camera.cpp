#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "render/stage.h"

namespace clothsim {
namespace {

constexpr double STEEPEST = 1.55;                   // [rad], short of the poles, where "up" has no direction
constexpr double AZIMUTH = 0.55, ELEVATION = 0.30;  // [rad], three-quarter view from slightly above
constexpr double FRAMED_ASPECT = 16.0 / 9.0;
constexpr double MARGIN = 1.10;  // room around what is framed

glm::vec3 directionOf(double azimuth, double elevation) {
  return {static_cast<float>(std::sin(azimuth) * std::cos(elevation)),
          static_cast<float>(std::sin(elevation)),
          static_cast<float>(std::cos(azimuth) * std::cos(elevation))};
}

struct Frame {
  glm::vec3 target;
  double distance;
};

// The nearest place, looking along -direction, from which the stage is in the picture, with it in the middle.
Frame frameStage(const Stage& stage, glm::vec3 direction, double fovDegrees) {
  const double tanY = std::tan(glm::radians(fovDegrees) / 2) / MARGIN, tanX = tanY * FRAMED_ASPECT;
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), direction));
  const glm::vec3 up = glm::cross(direction, right);
  const glm::vec3 middle = stage.view.center();
  // A point p is inside the picture's right edge when right.p <= tanX * (distance - direction.p), and so on.
  // The two opposite edges give the distance (their mean) and the middle (half their difference) at once.
  double leftmost = -1e30, rightmost = -1e30, lowest = -1e30, highest = -1e30;
  for (const glm::vec3 point : stage.shown) {
    const glm::vec3 p = point - middle;
    const double x = glm::dot(p, right), y = glm::dot(p, up), toward = glm::dot(p, direction);
    leftmost = std::max(leftmost, toward - x / tanX);
    rightmost = std::max(rightmost, toward + x / tanX);
    lowest = std::max(lowest, toward - y / tanY);
    highest = std::max(highest, toward + y / tanY);
  }
  const auto shiftRight = static_cast<float>(0.5 * (rightmost - leftmost) * tanX);
  const auto shiftUp = static_cast<float>(0.5 * (highest - lowest) * tanY);
  const double distance = std::max(0.5 * (leftmost + rightmost), 0.5 * (lowest + highest));
  return {middle + shiftRight * right + shiftUp * up, distance};
}

}  // namespace

Camera::Camera(const Scene& scene, const Cloth& cloth) {
  const ClothOutline outline = outlineOf(cloth);
  const Stage stage = makeStage(outline, scene);
  const CameraSettings& wanted = scene.camera;
  Place place;
  place.fov = wanted.fov;
  place.azimuth = std::atan2(outline.front.x, outline.front.z) + AZIMUTH;
  place.elevation = ELEVATION;
  if (wanted.position) {
    place.target = wanted.target ? toGlm(*wanted.target) : stage.view.center();
    const glm::vec3 offset = toGlm(*wanted.position) - place.target;
    place.distance = std::max(1e-3, static_cast<double>(glm::length(offset)));
    place.azimuth = std::atan2(offset.x, offset.z);
    place.elevation = std::clamp(std::asin(offset.y / place.distance), -STEEPEST, STEEPEST);
  } else {
    const Frame frame = frameStage(stage, directionOf(place.azimuth, place.elevation), place.fov);
    place.target = wanted.target ? toGlm(*wanted.target) : frame.target;
    place.distance = std::max(1e-3, frame.distance);
  }
  start_ = now_ = place;
}

void Camera::orbit(double azimuthRadians, double elevationRadians) {
  now_.azimuth += azimuthRadians;
  now_.elevation = std::clamp(now_.elevation + elevationRadians, -STEEPEST, STEEPEST);
}

void Camera::pan(double right, double up) {
  const glm::vec3 direction = directionOf(now_.azimuth, now_.elevation);
  const glm::vec3 sideways = glm::normalize(glm::cross(glm::vec3(0, 1, 0), direction));
  const glm::vec3 upward = glm::cross(direction, sideways);
  const double height = 2 * now_.distance * std::tan(glm::radians(now_.fov) / 2);
  now_.target += static_cast<float>(right * height) * sideways + static_cast<float>(up * height) * upward;
}

void Camera::zoom(double factor) { now_.distance = std::clamp(now_.distance * factor, 1e-3, 1e6); }

void Camera::reset() { now_ = start_; }

glm::vec3 Camera::eye() const {
  return now_.target + static_cast<float>(now_.distance) * directionOf(now_.azimuth, now_.elevation);
}

glm::mat4 Camera::view() const { return glm::lookAt(eye(), now_.target, glm::vec3(0, 1, 0)); }

glm::mat4 Camera::projection(double aspect) const {
  // Near and far follow the distance: depth stays precise at every zoom, and the floor's fading edge stays
  // in.
  return glm::perspective(static_cast<float>(glm::radians(now_.fov)), static_cast<float>(aspect),
                          static_cast<float>(0.03 * now_.distance), static_cast<float>(60 * now_.distance));
}

}  // namespace clothsim
