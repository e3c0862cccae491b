// The shapes of a gizmo's handles, for hits and for drawing.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "viewer/gizmo.h"

namespace clothsim::gizmo {

using Kind = GizmoHandle::Kind;

inline constexpr float arrowLength = 5.2f, arrowBegins = 0.75f, ringRadius = 4.6f, rimRadius = 5.5f;  // [em]
inline constexpr float squareFrom = 1.5f, squareTo = 2.7f, centerRadius = 0.55f;                      // [em]
inline constexpr float leastSlant =
    0.22f;  // sine below which an arrow points at the eye, or a square is a line
inline constexpr int ringPoints = 72;

[[nodiscard]] inline glm::vec3 unit(int axis) {
  glm::vec3 v{0};
  v[axis] = 1;
  return v;
}

[[nodiscard]] inline glm::vec3 toEye(const Gizmo& gizmo, const PictureView& view) {
  return glm::normalize(view.camera.eye() - gizmo.place);
}

[[nodiscard]] inline bool turns(Kind kind) { return kind == Kind::ring || kind == Kind::rim; }

// Arrows that point at the eye, and squares seen from the edge.
[[nodiscard]] inline bool isHidden(const GizmoHandle& handle, const Gizmo& gizmo, const PictureView& view) {
  const glm::vec3 eye = toEye(gizmo, view), axis = unit(handle.axis);
  if (handle.kind == Kind::arrow) return glm::length(glm::cross(axis, eye)) < leastSlant;
  return handle.kind == Kind::square && std::abs(glm::dot(axis, eye)) < leastSlant;
}

// Corners of a square in the plane across the axis, in the world. `emSize`: of an em at the gizmo [m].
[[nodiscard]] inline std::array<glm::vec3, 4> squareOf(int axis, const Gizmo& gizmo, float emSize) {
  const glm::vec3 u = unit((axis + 1) % 3), v = unit((axis + 2) % 3);
  const float a = squareFrom * emSize, b = squareTo * emSize;
  return {gizmo.place + a * u + a * v, gizmo.place + b * u + a * v, gizmo.place + b * u + b * v,
          gizmo.place + a * u + b * v};
}

struct RingPoint {
  glm::vec3 point{0};   // in the world [m]
  bool isNear = false;  // on the side of the eye
};
[[nodiscard]] inline std::array<RingPoint, ringPoints + 1> ringOf(int axis, const Gizmo& gizmo,
                                                                  const PictureView& view, float radius) {
  const glm::vec3 u = unit((axis + 1) % 3), v = unit((axis + 2) % 3), eye = toEye(gizmo, view);
  std::array<RingPoint, ringPoints + 1> points{};
  for (int i = 0; i <= ringPoints; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / ringPoints;
    const glm::vec3 out = std::cos(angle) * u + std::sin(angle) * v;
    points[static_cast<std::size_t>(i)] = {gizmo.place + radius * out, glm::dot(out, eye) > -0.05f};
  }
  return points;
}

}  // namespace clothsim::gizmo
