// A closed triangle mesh, and a series of them that have the same triangles: shapes that a body takes one
// after the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.h"

namespace clothsim {

struct MeshCollider;

struct SolidMesh {
  using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise from outside
  std::vector<Vec3d> points;                      // [m], in the collider's own frame, scaled
  std::vector<Vec3d> normals;                     // of the points, unit
  std::vector<Triangle> triangles;
};

// A point of a mesh: a triangle, and the weights of its corners, which sum to 1.
struct MeshPoint {
  std::size_t triangle = 0;
  std::array<double, 3> weights{};
};
[[nodiscard]] Vec3d placeOf(const SolidMesh& mesh, const MeshPoint& point);

// Reads an OBJ file. @throws SceneError when it cannot be read, holds no triangles, or is not closed
[[nodiscard]] SolidMesh loadSolidMesh(const std::string& file, double scale);
// All shapes of a collider. @throws SceneError as loadSolidMesh, and when their triangles differ
[[nodiscard]] std::vector<SolidMesh> loadShapes(const MeshCollider& collider);

// Points on the straight way from those of `a`, `part` 0, to those of `b`, 1, with the normals there.
[[nodiscard]] SolidMesh between(const SolidMesh& a, const SolidMesh& b, double part);

// The corners of the box around two points.
[[nodiscard]] Vec3d lowerCorner(Vec3d a, Vec3d b);
[[nodiscard]] Vec3d upperCorner(Vec3d a, Vec3d b);
[[nodiscard]] Vec3d unitVector(Vec3d v);  // 0 stays 0

}  // namespace clothsim
