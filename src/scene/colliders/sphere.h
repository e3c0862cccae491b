#pragma once

#include "scene/colliders/shape.h"

namespace clothsim {

struct Sphere {
  static constexpr std::string_view type = "sphere";
  Vec3d origin{0, 0, 0};  // centre [m]
  double radius = 0.2;    // [m]
  double friction = 0.5;  // CS184's factor, 0 slides, 1 sticks; Coulomb's coefficient under `coulomb`
  std::optional<Motion> motion{};
  SolidLook render{};
  friend bool operator==(const Sphere&, const Sphere&) = default;

  [[nodiscard]] static std::span<const Field<Sphere>> fields();
  [[nodiscard]] Vec3d& place() { return origin; }
  [[nodiscard]] const Vec3d& place() const { return origin; }
  [[nodiscard]] Matrix3 ownRotation() const { return identityMatrix; }

  // A sphere sweeps when a step is longer than 0.39 radii, below which no particle gets past the cap it
  // entered by, and ignores passages that dip by less than 8 % of the radius.
  template <class Params>
  void pack(Params& params, const Matrix3&) const {
    const double radiusSquared = radius * radius;
    put(params.radius, radius);
    put(params.radiusSquared, radiusSquared);
    put(params.sweepSquared, 0.15 * radiusSquared);
    put(params.grazeSquared, 0.85 * radiusSquared);
    put(params.inverseRadius, 1 / radius);
  }
  [[nodiscard]] double distance(Vec3d p) const { return length(p) - radius; }
  [[nodiscard]] Surface surface(double) const { return {}; }  // drawn by a program of its own
  [[nodiscard]] Vec3d halfExtent(const Matrix3&) const { return {radius, radius, radius}; }
};

}  // namespace clothsim
