#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

#include "render/stage.h"

namespace clothsim {
namespace {

constexpr double steepest = 1.55;  // [rad], short of the poles, where "up" has no direction
constexpr double defaultAzimuth = 0.55,
                 defaultElevation = 0.30;                     // [rad], three-quarter view from slightly above
constexpr double widestFramed = 16.0 / 9.0;                   // wider pictures show more at the sides
constexpr double stayingMargin = 1.14, passingMargin = 1.05;  // room around what is framed

glm::vec3 directionOf(double azimuth, double elevation) {
  return {static_cast<float>(std::sin(azimuth) * std::cos(elevation)),
          static_cast<float>(std::sin(elevation)),
          static_cast<float>(std::cos(azimuth) * std::cos(elevation))};
}

struct Frame {
  glm::vec3 target;
  double distance;
};

// A point as seen along the viewing direction: across the picture, and towards the viewer; the tangents are
// those of the field of view that the point may use, to either side of its middle.
struct SeenPoint {
  double across, toward, tangentBelow, tangentAbove;
};

struct AxisFrame {
  double middle, distance;
};

// The middle of the picture along one of its axes for which the viewer can be nearest. A point is inside both
// edges when |across - middle| <= tangent * (distance - toward) of its side; the distance this needs is
// convex in the middle.
AxisFrame frameAxis(const std::vector<SeenPoint>& points) {
  const auto distanceFor = [&](double middle) {
    double distance = 0;
    for (const SeenPoint& p : points)
      distance = std::max(distance, p.toward + (p.across > middle ? (p.across - middle) / p.tangentAbove
                                                                  : (middle - p.across) / p.tangentBelow));
    return distance;
  };
  double low = 1e30, high = -1e30;
  for (const SeenPoint& p : points) {
    low = std::min(low, p.across);
    high = std::max(high, p.across);
  }
  for (int i = 0; i < 40; ++i) {  // each step leaves two thirds
    const double first = low + (high - low) / 3, second = high - (high - low) / 3;
    (distanceFor(first) < distanceFor(second) ? high : low) =
        distanceFor(first) < distanceFor(second) ? second : first;
  }
  return {low, distanceFor(low)};
}

// The nearest place, looking along -direction, from which the stage is in the free part of the picture, with
// room around what stays there.
Frame frameStage(const Stage& stage, glm::vec3 direction, double fovDegrees, double aspect,
                 const CoveredEdges& covered) {
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), direction));
  const glm::vec3 up = glm::cross(direction, right);
  const glm::vec3 center = stage.view.center();
  std::vector<SeenPoint> horizontal, vertical;
  const double free = std::max(0.2, 1 - covered.left - covered.right),
               freeHeight = std::max(0.2, 1 - covered.bottom - covered.top);
  const auto add = [&](const std::vector<glm::vec3>& points, double margin) {
    const double tangent = std::tan(glm::radians(fovDegrees) / 2);
    // Of the free part an even rim stays empty.
    const double rim = 1 - 1 / margin;
    const auto used = [&](double coveredPart, double freePart) {
      return 1 - 2 * coveredPart - rim * freePart;
    };
    for (const glm::vec3 point : points) {
      const glm::vec3 p = point - center;
      const double across = glm::dot(p, right), upward = glm::dot(p, up), toward = glm::dot(p, direction);
      horizontal.push_back({across, toward, tangent * aspect * used(covered.left, free),
                            tangent * aspect * used(covered.right, free)});
      vertical.push_back({upward, toward, tangent * used(covered.bottom, freeHeight),
                          tangent * used(covered.top, freeHeight)});
    }
  };
  add(stage.staying, stayingMargin);
  add(stage.passing, passingMargin);
  const AxisFrame x = frameAxis(horizontal), y = frameAxis(vertical);
  return {center + static_cast<float>(x.middle) * right + static_cast<float>(y.middle) * up,
          std::max(x.distance, y.distance)};
}

}  // namespace

Camera::Camera(const Scene& scene, const Cloth& cloth, double aspect, const CoveredEdges& covered) {
  const double framed = std::clamp(aspect, 0.2, widestFramed);
  const ClothOutline outline = outlineOf(cloth);
  const Stage stage = makeStage(outline, scene);
  const CameraSettings& wanted = scene.camera;
  back_ = widestFramed / framed;
  Place place;
  place.fov = wanted.fov;
  place.azimuth = std::atan2(outline.front.x, outline.front.z) + defaultAzimuth;
  place.elevation = defaultElevation;
  if (wanted.position) {
    place.target = wanted.target ? toGlm(*wanted.target) : stage.view.center();
    const glm::vec3 offset = toGlm(*wanted.position) - place.target;
    place.distance = std::max(1e-3, static_cast<double>(glm::length(offset)));
    place.azimuth = std::atan2(offset.x, offset.z);
    place.elevation = std::clamp(std::asin(offset.y / place.distance), -steepest, steepest);
    place.distance *= back_;
  } else {
    const Frame frame =
        frameStage(stage, directionOf(place.azimuth, place.elevation), place.fov, framed, covered);
    place.target = wanted.target ? toGlm(*wanted.target) : frame.target;
    place.distance = std::max(1e-3, frame.distance);
  }
  start_ = now_ = place;
}

Camera pictureCamera(const Scene& scene, const Cloth& cloth, int width, int height) {
  return Camera(scene, cloth, scene.camera.position ? widestFramed : static_cast<double>(width) / height);
}

void Camera::orbit(double azimuthRadians, double elevationRadians) {
  now_.azimuth += azimuthRadians;
  now_.elevation = std::clamp(now_.elevation + elevationRadians, -steepest, steepest);
}

void Camera::pan(double right, double up) {
  const glm::vec3 direction = directionOf(now_.azimuth, now_.elevation);
  const glm::vec3 sideways = glm::normalize(glm::cross(glm::vec3(0, 1, 0), direction));
  const glm::vec3 upward = glm::cross(direction, sideways);
  const double height = 2 * now_.distance * std::tan(glm::radians(now_.fov) / 2);
  now_.target += static_cast<float>(right * height) * sideways + static_cast<float>(up * height) * upward;
}

void Camera::zoom(double factor) { now_.distance = std::clamp(now_.distance * factor, 1e-3, 1e6); }

void Camera::lookFrom(int axis, bool fromPositiveEnd) {
  const auto from = [&](bool isPositive) {
    Place place = now_;
    const double sign = isPositive ? 1 : -1;
    place.azimuth = axis == 0 ? sign * std::numbers::pi / 2 : axis == 2 && !isPositive ? std::numbers::pi : 0;
    place.elevation = axis == 1 ? sign * steepest : 0;
    return place;
  };
  now_ = from(fromPositiveEnd) == now_ ? from(!fromPositiveEnd) : from(fromPositiveEnd);
}

void Camera::reset() { now_ = start_; }

void Camera::setHome(const Camera& other) {
  if (now_ == start_) now_ = other.start_;
  start_ = other.start_;
  back_ = other.back_;
}

glm::vec3 Camera::eye() const {
  return now_.target + static_cast<float>(now_.distance) * directionOf(now_.azimuth, now_.elevation);
}

CameraSettings Camera::settings(CameraSettings own) const {
  if (now_ == start_) return own;
  const glm::vec3 direction = directionOf(now_.azimuth, now_.elevation);
  const auto rounded = [](glm::vec3 place) {  // to read
    const Vec3d whole = toVec3d(glm::round(1e5f * place));
    return Vec3d{whole.x / 1e5, whole.y / 1e5, whole.z / 1e5};
  };
  own.target = rounded(now_.target);
  own.position = rounded(now_.target + static_cast<float>(now_.distance / back_) * direction);
  return own;
}

glm::mat4 Camera::view() const { return glm::lookAt(eye(), now_.target, glm::vec3(0, 1, 0)); }

glm::mat4 Camera::projection(double aspect) const {
  // Near and far follow the distance: depth stays precise at every zoom, and the floor's fading edge stays
  // in.
  return glm::perspective(static_cast<float>(glm::radians(now_.fov)), static_cast<float>(aspect),
                          static_cast<float>(0.03 * now_.distance), static_cast<float>(60 * now_.distance));
}

}  // namespace clothsim
