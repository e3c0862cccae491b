#pragma once

#include "scene/colliders/shape.h"

namespace clothsim {

// All points within `tubeRadius` of a circle; its own frame has the circle around y.
struct Torus {
  static constexpr std::string_view type = "torus";
  Vec3d origin{0, 0, 0};    // centre [m]
  Vec3d axis{0, 1, 0};      // through the hole, any length but 0
  double radius = 0.3;      // of the circle [m]
  double tubeRadius = 0.1;  // [m], smaller than radius
  double friction = 0.5;
  std::optional<Motion> motion{};
  SolidLook render{};
  friend bool operator==(const Torus&, const Torus&) = default;

  [[nodiscard]] static std::span<const Field<Torus>> fields();
  [[nodiscard]] std::optional<Misfit> finishReading(const IsGiven& isGiven) const;
  [[nodiscard]] Vec3d& place() { return origin; }
  [[nodiscard]] const Vec3d& place() const { return origin; }
  [[nodiscard]] Matrix3 ownRotation() const { return rotationFromY(axis); }

  template <class Params>
  void pack(Params& params, const Matrix3&) const {
    put(params.radius, tubeRadius);
    put(params.sizeX, radius);
  }
  [[nodiscard]] double distance(Vec3d p) const;
  [[nodiscard]] Surface surface(double longestEdge) const;
  [[nodiscard]] Vec3d halfExtent(const Matrix3& rotation) const;
};

}  // namespace clothsim
