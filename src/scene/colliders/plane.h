#pragma once

#include "scene/colliders/shape.h"

namespace clothsim {

// Endless; its own frame has the normal along y.
struct Plane {
  static constexpr std::string_view type = "plane";
  Vec3d point{0, 0, 0};   // [m]
  Vec3d normal{0, 1, 0};  // any length but 0
  double friction = 0.5;
  std::optional<Motion> motion{};
  SolidLook render{};
  friend bool operator==(const Plane&, const Plane&) = default;

  [[nodiscard]] static std::span<const Field<Plane>> fields();
  [[nodiscard]] Vec3d& place() { return point; }
  [[nodiscard]] const Vec3d& place() const { return point; }
  [[nodiscard]] Matrix3 ownRotation() const { return rotationFromY(normal); }

  template <class Params>
  void pack(Params& params, const Matrix3& rotation) const {
    const Vec3d rotated = rotate(rotation, normal);
    const Vec3d unit = (1 / length(rotated)) * rotated;
    put(params.normalX, unit.x);
    put(params.normalY, unit.y);
    put(params.normalZ, unit.z);
  }
  [[nodiscard]] double distance(Vec3d p) const { return p.y; }
  [[nodiscard]] Surface surface(double) const { return {}; }           // drawn by a program of its own
  [[nodiscard]] Vec3d halfExtent(const Matrix3&) const { return {}; }  // nothing to frame or to fall around
};

}  // namespace clothsim
