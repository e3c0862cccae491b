#pragma once

#include <string>

#include "scene/colliders/shape.h"

namespace clothsim {

// The inside of a closed triangle mesh.
struct MeshCollider {
  static constexpr std::string_view type = "mesh";
  std::string file;         // OBJ, beside the scene file or below the resource root
  Vec3d origin{0, 0, 0};    // where the mesh's own origin stands [m]
  Vec3d rotation{0, 0, 0};  // rotation vector [degrees]; a motion rotates the mesh beyond this
  double scale = 1;         // metres in a unit of the file
  int cells = 64;           // of the signed distance grid, along the longest side
  double friction = 0.5;
  std::optional<Motion> motion{};
  friend bool operator==(const MeshCollider&, const MeshCollider&) = default;

  [[nodiscard]] static std::span<const Field<MeshCollider>> fields();
  [[nodiscard]] std::optional<Misfit> finishReading(const IsGiven& isGiven) const;
  [[nodiscard]] Vec3d& place() { return origin; }
  [[nodiscard]] const Vec3d& place() const { return origin; }
  [[nodiscard]] Matrix3 ownRotation() const { return rotationMatrix(rotation); }
};

}  // namespace clothsim
