#pragma once

#include <cmath>

#include "scene/colliders/shape.h"

namespace clothsim {

// From one flat cap to another, with sharp rims; its own frame has the axis along y.
struct Cone {
  static constexpr std::string_view type = "cone";
  Vec3d origin{0, 0, 0};  // middle of the axis [m]
  Vec3d axis{0, 1, 0};    // from the lower cap to the upper one, any length but 0
  double height = 0.5;    // from cap to cap [m]
  double radius = 0.2;    // of the lower cap [m]
  double topRadius = 0;   // of the upper cap [m]; 0: a point
  double friction = 0.5;
  std::optional<Motion> motion{};
  SolidLook render{};
  friend bool operator==(const Cone&, const Cone&) = default;

  [[nodiscard]] static std::span<const Field<Cone>> fields();
  [[nodiscard]] Vec3d& place() { return origin; }
  [[nodiscard]] const Vec3d& place() const { return origin; }
  [[nodiscard]] Matrix3 ownRotation() const { return rotationFromY(axis); }

  template <class Params>
  void pack(Params& params, const Matrix3&) const {
    const double slant = std::hypot(height, radius - topRadius);
    put(params.radius, slant);
    put(params.sizeX, radius);
    put(params.sizeY, 0.5 * height);
    put(params.sizeZ, topRadius);
    put(params.normalX, height / slant);
    put(params.normalY, (radius - topRadius) / slant);
  }
  [[nodiscard]] double distance(Vec3d p) const;
  [[nodiscard]] Surface surface(double longestEdge) const;
  [[nodiscard]] Vec3d halfExtent(const Matrix3& rotation) const;
};

}  // namespace clothsim
