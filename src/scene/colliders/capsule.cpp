#include "scene/colliders/capsule.h"

#include <algorithm>

#include "scene/colliders/shape_fields.h"
#include "scene/colliders/surface.h"

namespace clothsim {

std::span<const Field<Capsule>> Capsule::fields() {
  static const std::array fields{
      field("origin", &Capsule::origin, "Middle of a capsule.").in("m"),
      field("axis", &Capsule::axis, "Axis of a round shape (through the hole of a torus), of any length.")
          .within({.nonZero = true}),
      field("length", &Capsule::length, "Length of a capsule without its round ends.")
          .in("m")
          .within(notNegative)
          .usually(0, 2),
      field("radius", &Capsule::radius, "Radius of a capsule.").in("m").within(positive).usually(0.01, 1),
      frictionField<Capsule>(),
      motionField<Capsule>(),
      lookField<Capsule>(),
  };
  return fields;
}

double Capsule::distance(Vec3d p) const {
  const double half = 0.5 * length;
  return clothsim::length({p.x, p.y - std::clamp(p.y, -half, half), p.z}) - radius;
}

Surface Capsule::surface(double longestEdge) const {
  return pulledApart(0, 0.5 * length, 0, radius - sphereShrink(radius, longestEdge));
}

Vec3d Capsule::halfExtent(const Matrix3& rotation) const {
  return magnitude(rotate(rotation, {0, 0.5 * length, 0})) + Vec3d{radius, radius, radius};
}

}  // namespace clothsim
