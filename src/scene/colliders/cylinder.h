#pragma once

#include "scene/colliders/shape.h"

namespace clothsim {

// With flat caps and sharp rims; its own frame has the axis along y.
struct Cylinder {
  static constexpr std::string_view type = "cylinder";
  Vec3d origin{0, 0, 0};  // centre [m]
  Vec3d axis{0, 1, 0};    // any length but 0
  double height = 0.5;    // from cap to cap [m]
  double radius = 0.2;    // [m]
  double friction = 0.5;
  std::optional<Motion> motion{};
  SolidLook render{};
  friend bool operator==(const Cylinder&, const Cylinder&) = default;

  [[nodiscard]] static std::span<const Field<Cylinder>> fields();
  [[nodiscard]] Vec3d& place() { return origin; }
  [[nodiscard]] const Vec3d& place() const { return origin; }
  [[nodiscard]] Matrix3 ownRotation() const { return rotationFromY(axis); }

  template <class Params>
  void pack(Params& params, const Matrix3&) const {
    put(params.radius, radius);
    put(params.sizeY, 0.5 * height);
  }
  [[nodiscard]] double distance(Vec3d p) const;
  [[nodiscard]] Surface surface(double longestEdge) const;
  [[nodiscard]] Vec3d halfExtent(const Matrix3& rotation) const;
};

}  // namespace clothsim
