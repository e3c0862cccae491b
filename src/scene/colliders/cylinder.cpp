#include "scene/colliders/cylinder.h"

#include <algorithm>
#include <cmath>

#include "scene/colliders/shape_fields.h"
#include "scene/colliders/surface.h"

namespace clothsim {

std::span<const Field<Cylinder>> Cylinder::fields() {
  using C = Cylinder;
  static const std::array fields{
      field("origin", &C::origin, "Centre of a cylinder.").in("m"),
      field("axis", &C::axis, "Axis of a cylinder.").within({.nonZero = true}),
      field("height", &C::height, "Height of a cylinder or cone, from cap to cap.")
          .in("m")
          .within(positive)
          .usually(0.01, 2),
      field("radius", &C::radius, "Radius of a cylinder.").in("m").within(positive).usually(0.01, 1),
      frictionField<C>(),
      motionField<C>(),
      lookField<C>(),
  };
  return fields;
}

double Cylinder::distance(Vec3d p) const {
  const double beyondSide = std::hypot(p.x, p.z) - radius, beyondCap = std::abs(p.y) - 0.5 * height;
  return std::hypot(std::max(beyondSide, 0.0), std::max(beyondCap, 0.0)) +
         std::min(std::max(beyondSide, beyondCap), 0.0);
}

// Cloth of edge length L bent around a rim cuts it off by L / 2 at most. A bevel of half a right angle makes
// way for it.
Surface Cylinder::surface(double longestEdge) const {
  const double smallest = std::min(height, 2 * radius);
  const double r = radius - sphereShrink(radius, longestEdge);
  const double h = 0.5 * height - faceInset(smallest, longestEdge);
  const double bevel = std::min({0.71 * longestEdge, 0.45 * r, 0.45 * h}), diagonal = std::sqrt(0.5);
  return revolved({{0, h, 0, 1},
                   {r - bevel, h, 0, 1},
                   {r - bevel, h, diagonal, diagonal},
                   {r, h - bevel, diagonal, diagonal},
                   {r, h - bevel, 1, 0},
                   {r, bevel - h, 1, 0},
                   {r, bevel - h, diagonal, -diagonal},
                   {r - bevel, -h, diagonal, -diagonal},
                   {r - bevel, -h, 0, -1},
                   {0, -h, 0, -1}});
}

Vec3d Cylinder::halfExtent(const Matrix3& rotation) const {
  const auto reach = [&](const Vec3d& row) {
    return std::abs(row.y) * 0.5 * height + std::hypot(row.x, row.z) * radius;
  };
  return {reach(rotation[0]), reach(rotation[1]), reach(rotation[2])};
}

}  // namespace clothsim
