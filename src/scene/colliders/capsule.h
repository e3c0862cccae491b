#pragma once

#include "scene/colliders/shape.h"

namespace clothsim {

// All points within `radius` of a line segment; its own frame has the segment along y.
struct Capsule {
  static constexpr std::string_view type = "capsule";
  Vec3d origin{0, 0, 0};  // middle of the segment [m]
  Vec3d axis{0, 1, 0};    // its direction, any length but 0
  double length = 0.5;    // of the segment, without the round ends [m]
  double radius = 0.1;    // [m]
  double friction = 0.5;
  std::optional<Motion> motion{};
  SolidLook render{};
  friend bool operator==(const Capsule&, const Capsule&) = default;

  [[nodiscard]] static std::span<const Field<Capsule>> fields();
  [[nodiscard]] Vec3d& place() { return origin; }
  [[nodiscard]] const Vec3d& place() const { return origin; }
  [[nodiscard]] Matrix3 ownRotation() const { return rotationFromY(axis); }

  template <class Params>
  void pack(Params& params, const Matrix3&) const {
    put(params.radius, radius);
    put(params.sizeY, 0.5 * length);
  }
  [[nodiscard]] double distance(Vec3d p) const;
  [[nodiscard]] Surface surface(double longestEdge) const;
  [[nodiscard]] Vec3d halfExtent(const Matrix3& rotation) const;
};

}  // namespace clothsim
