#pragma once

#include "scene/colliders/shape.h"

namespace clothsim {

struct Box {
  static constexpr std::string_view type = "box";
  Vec3d origin{0, 0, 0};      // centre [m]
  Vec3d size{0.5, 0.5, 0.5};  // from face to face, rounding included [m]
  Vec3d rotation{0, 0, 0};    // rotation vector [degrees]; a motion rotates the box beyond this
  double rounding = 0.01;     // radius of its edges [m], at most half the smallest size
  double friction = 0.5;
  std::optional<Motion> motion{};
  SolidLook render{};
  friend bool operator==(const Box&, const Box&) = default;

  [[nodiscard]] static std::span<const Field<Box>> fields();
  [[nodiscard]] std::optional<Misfit> finishReading(const IsGiven& isGiven);
  [[nodiscard]] Vec3d& place() { return origin; }
  [[nodiscard]] const Vec3d& place() const { return origin; }
  [[nodiscard]] Matrix3 ownRotation() const { return rotationMatrix(rotation); }

  template <class Params>
  void pack(Params& params, const Matrix3&) const {
    put(params.radius, rounding);
    put(params.sizeX, 0.5 * size.x - rounding);
    put(params.sizeY, 0.5 * size.y - rounding);
    put(params.sizeZ, 0.5 * size.z - rounding);
  }
  [[nodiscard]] double distance(Vec3d p) const;
  [[nodiscard]] Surface surface(double longestEdge) const;
  [[nodiscard]] Vec3d halfExtent(const Matrix3& rotated) const;
};

}  // namespace clothsim
