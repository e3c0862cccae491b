#include "scene/colliders/box.h"

#include <algorithm>
#include <cmath>

#include "scene/colliders/shape_fields.h"
#include "scene/colliders/surface.h"

namespace clothsim {

std::span<const Field<Box>> Box::fields() {
  static const std::array fields{
      field("origin", &Box::origin, "Centre of a box.").in("m"),
      field("size", &Box::size, "Size of a box from face to face.").in("m").within(positive).usually(0.01, 3),
      field("rotation", &Box::rotation,
            "Rotation of a box or mesh: axis times angle; its motion is added to it.")
          .in("degrees"),
      field("rounding", &Box::rounding, "Radius of a box's edges, at most half its smallest size.")
          .in("m")
          .within(notNegative)
          .usually(0, 0.2),
      frictionField<Box>(),
      motionField<Box>(),
      lookField<Box>(),
  };
  return fields;
}

std::optional<Misfit> Box::finishReading(const IsGiven& isGiven) {
  const double most = 0.5 * std::min({size.x, size.y, size.z});
  if (rounding <= most) return std::nullopt;
  if (isGiven("rounding")) return Misfit{"rounding", "at most half the smallest size of the box, ", most};
  rounding = most;  // a box thinner than the default rounding is simply round
  return std::nullopt;
}

double Box::distance(Vec3d p) const {
  const Vec3d beyond = magnitude(p) - (0.5 * size - rounding * Vec3d{1, 1, 1});
  const double inside = std::min(std::max({beyond.x, beyond.y, beyond.z}), 0.0);
  return length({std::max(beyond.x, 0.0), std::max(beyond.y, 0.0), std::max(beyond.z, 0.0)}) + inside -
         rounding;
}

// Cloth of edge length L bent around a sharp right angle cuts it off by L / 2 at most; a rounding of radius r
// gives way by (sqrt(2) - 1) r.
Surface Box::surface(double longestEdge) const {
  const double smallest = std::min({size.x, size.y, size.z});
  const double inset = faceInset(smallest, longestEdge);
  const double radius = std::min(rounding + 1.2 * longestEdge, 0.45 * smallest);
  const auto half = [&](double side) { return std::max(0.5 * side - inset - radius, 0.0); };
  return pulledApart(half(size.x), half(size.y), half(size.z), radius);
}

Vec3d Box::halfExtent(const Matrix3& rotated) const {
  return magnitude(rotate(rotated, {0.5 * size.x, 0, 0})) + magnitude(rotate(rotated, {0, 0.5 * size.y, 0})) +
         magnitude(rotate(rotated, {0, 0, 0.5 * size.z}));
}

}  // namespace clothsim
