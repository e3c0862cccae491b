#include "scene/colliders/torus.h"

#include <cmath>
#include <numbers>

#include "scene/colliders/shape_fields.h"
#include "scene/colliders/surface.h"

namespace clothsim {

std::span<const Field<Torus>> Torus::fields() {
  static const std::array fields{
      field("origin", &Torus::origin, "Centre of a torus.").in("m"),
      field("axis", &Torus::axis, "Through the hole of a torus.").within({.nonZero = true}),
      field("radius", &Torus::radius, "Radius of the circle inside the tube.")
          .in("m")
          .within(positive)
          .usually(0.01, 1),
      field("tube_radius", &Torus::tubeRadius, "Radius of the tube of a torus, smaller than its radius.")
          .in("m")
          .within(positive)
          .usually(0.01, 1),
      frictionField<Torus>(),
      motionField<Torus>(),
      lookField<Torus>(),
  };
  return fields;
}

std::optional<Misfit> Torus::finishReading(const IsGiven&) const {
  if (tubeRadius < radius) return std::nullopt;
  return Misfit{"tube_radius", "a tube_radius below the radius ", radius};
}

double Torus::distance(Vec3d p) const { return std::hypot(std::hypot(p.x, p.z) - radius, p.y) - tubeRadius; }

Surface Torus::surface(double longestEdge) const {
  const double tube = tubeRadius - sphereShrink(tubeRadius, longestEdge);
  constexpr int tubeSegments = 4 * quarterSegments;
  std::vector<ProfilePoint> circle;
  for (int i = 0; i <= tubeSegments; ++i) {
    const double angle = -2 * std::numbers::pi * i / tubeSegments;
    const double outward = std::cos(angle), up = std::sin(angle);
    circle.push_back({radius + tube * outward, tube * up, outward, up});
  }
  return revolved(circle);
}

Vec3d Torus::halfExtent(const Matrix3& rotation) const {
  const auto across = [&](const Vec3d& row) { return std::hypot(row.x, row.z) * radius + tubeRadius; };
  return {across(rotation[0]), across(rotation[1]), across(rotation[2])};
}

}  // namespace clothsim
