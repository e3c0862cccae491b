#pragma once

#include <cstddef>
#include <string>

#include "scene/colliders/shape.h"

namespace clothsim {

// Which two shapes of a body it is between at a time, and how far on the way from one to the other, 0 to 1.
struct ShapeMoment {
  std::size_t from = 0, to = 0;
  double part = 0;
  friend bool operator==(const ShapeMoment&, const ShapeMoment&) = default;
};

// The inside of a closed triangle mesh. With more shapes than one it is a body that goes on straight ways
// from each shape to the next.
struct MeshCollider {
  static constexpr std::string_view type = "mesh";
  std::string file;         // OBJ, beside the scene file or below the resource root; of several shapes with
                            // a place for their numbers, "walk_%03d.obj"
  Vec3d origin{0, 0, 0};    // where the mesh's own origin stands [m]
  Vec3d rotation{0, 0, 0};  // rotation vector [degrees]; a motion rotates the mesh beyond this
  double scale = 1;         // metres in a unit of the file
  int cells = 64;           // of the signed distance grid, along the longest side
  double friction = 0.5;
  std::optional<Motion> motion{};
  SolidLook render{};
  int shapes = 1;
  int firstShape = 0;           // the number of the first file
  double shapesPerSecond = 24;  // [1/s]
  double shapesStart = 0;       // when the first shape is there [s]
  bool shapesLoop = false;      // after the last shape the first one follows; otherwise it stays
  friend bool operator==(const MeshCollider&, const MeshCollider&) = default;

  [[nodiscard]] static std::span<const Field<MeshCollider>> fields();
  [[nodiscard]] std::optional<Misfit> finishReading(const IsGiven& isGiven) const;
  [[nodiscard]] Vec3d& place() { return origin; }
  [[nodiscard]] const Vec3d& place() const { return origin; }
  [[nodiscard]] bool deforms() const { return shapes > 1; }
  [[nodiscard]] std::string fileOf(int shape) const;
  // How many shapes it has come on at `time` [s], and what it is between then.
  [[nodiscard]] double progressAt(double time) const;
  [[nodiscard]] ShapeMoment momentAt(double progress) const;
  [[nodiscard]] Matrix3 ownRotation() const { return rotationMatrix(rotation); }
};

}  // namespace clothsim
