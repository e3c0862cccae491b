#include "scene/colliders/cone.h"

#include <algorithm>
#include <cmath>

#include "scene/colliders/shape_fields.h"
#include "scene/colliders/surface.h"

namespace clothsim {

std::span<const Field<Cone>> Cone::fields() {
  using C = Cone;
  static const std::array fields{
      field("origin", &C::origin, "Middle of the axis of a cone.").in("m"),
      field("axis", &C::axis, "From the lower cap of a cone to the upper one.").within({.nonZero = true}),
      field("height", &C::height, "Height of a cone.").in("m").within(positive).usually(0.01, 2),
      field("radius", &C::radius, "Radius of the lower cap of a cone.")
          .in("m")
          .within(positive)
          .usually(0.01, 1),
      field("top_radius", &C::topRadius, "Radius of the upper cap of a cone; 0: a point.")
          .in("m")
          .within(notNegative)
          .usually(0, 1),
      frictionField<C>(),
      motionField<C>(),
      lookField<C>(),
  };
  return fields;
}

// In the half-plane of p and the axis: to the nearer cap, and to the slanted side (Inigo Quilez, "Distance
// functions", capped cone).
double Cone::distance(Vec3d p) const {
  const double r = std::hypot(p.x, p.z), half = 0.5 * height, narrowing = topRadius - radius;
  const double capR = r - std::min(r, p.y < 0 ? radius : topRadius), capY = std::abs(p.y) - half;
  const double along =
      ((topRadius - r) * narrowing + (half - p.y) * height) / (narrowing * narrowing + height * height);
  const double t = std::clamp(along, 0.0, 1.0);
  const double sideR = r - topRadius + narrowing * t, sideY = p.y - half + height * t;
  const double least = std::min(std::hypot(capR, capY), std::hypot(sideR, sideY));
  return sideR < 0 && capY < 0 ? -least : least;
}

// Inside of the shape, with bevelled rims: see Cylinder::surface.
Surface Cone::surface(double longestEdge) const {
  const double largest = std::max(radius, topRadius), slant = std::hypot(height, radius - topRadius);
  const double normalR = height / slant, normalY = (radius - topRadius) / slant;
  const double inset = faceInset(std::min(height, 2 * largest), longestEdge);
  const double sideInset = sphereShrink(largest, longestEdge) / normalR;
  const double slope = (topRadius - radius) / height;
  double top = 0.5 * height - inset, bottom = -top;
  const auto radiusAt = [&](double y) { return radius + slope * (y + 0.5 * height) - sideInset; };
  if (radiusAt(top) < 0) top -= radiusAt(top) / slope;  // a point
  if (radiusAt(bottom) < 0) bottom -= radiusAt(bottom) / slope;
  const auto bevelOf = [&](double rim) {
    return std::max(std::min({0.71 * longestEdge, 0.45 * rim, 0.45 * (top - bottom)}), 0.0);
  };
  const double topRim = std::max(radiusAt(top), 0.0), bottomRim = std::max(radiusAt(bottom), 0.0);
  const double topBevel = bevelOf(topRim), bottomBevel = bevelOf(bottomRim);
  const struct {
    double r, y;
  } corners[] = {{0, top},
                 {topRim - topBevel, top},
                 {topRim + topBevel * normalY, top - topBevel * normalR},
                 {bottomRim - bottomBevel * normalY, bottom + bottomBevel * normalR},
                 {bottomRim - bottomBevel, bottom},
                 {0, bottom}};
  std::vector<ProfilePoint> profile;
  for (std::size_t i = 0; i + 1 < std::size(corners); ++i) {
    const double dr = corners[i + 1].r - corners[i].r, dy = corners[i + 1].y - corners[i].y;
    const double length = std::hypot(dr, dy);
    if (length == 0) continue;
    for (const auto& corner : {corners[i], corners[i + 1]})
      profile.push_back({corner.r, corner.y, -dy / length, dr / length});
  }
  return revolved(profile);
}

Vec3d Cone::halfExtent(const Matrix3& rotation) const {
  const auto reach = [&](const Vec3d& row) {
    return std::abs(row.y) * 0.5 * height + std::hypot(row.x, row.z) * std::max(radius, topRadius);
  };
  return {reach(rotation[0]), reach(rotation[1]), reach(rotation[2])};
}

}  // namespace clothsim
