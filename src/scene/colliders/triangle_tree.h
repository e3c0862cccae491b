// The nearest place of a triangle mesh. Distances go to the nearest point of the nearest triangle (Ericson,
// Real-Time Collision Detection, 5.1.5), found in a tree of boxes; signs come from angle-weighted
// pseudonormals (Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal",
// 2005).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/colliders/solid_mesh.h"

namespace clothsim {

// Eight places, by coordinate [m].
struct EightPlaces {
  static constexpr std::size_t EIGHT = 8;
  using Numbers = std::array<double, EIGHT>;
  alignas(64) Numbers x, y, z;

  void set(std::size_t k, Vec3d p) { x[k] = p.x, y[k] = p.y, z[k] = p.z; }
  [[nodiscard]] Vec3d at(std::size_t k) const { return {x[k], y[k], z[k]}; }
};

// Triangles in a tree of bounding boxes, halved at the median of their middles. Eight places that lie side by
// side go down the tree together, in vectors.
class TriangleTree {
 public:
  explicit TriangleTree(const SolidMesh& mesh);  // which must outlive it

  // Negative inside [m].
  [[nodiscard]] double signedDistance(Vec3d p) const;
  [[nodiscard]] EightPlaces::Numbers signedDistances(const EightPlaces& places) const;
  [[nodiscard]] MeshPoint nearestPoint(Vec3d p) const;
  [[nodiscard]] std::array<MeshPoint, EightPlaces::EIGHT> nearestPoints(const EightPlaces& places) const;

  struct Node {
    Vec3d low, high;
    std::uint32_t first = 0, count = 0;  // of the triangles in order, in a leaf
    std::uint32_t left = 0, right = 0;   // nodes, elsewhere
  };
  struct Triangle {
    Vec3d a, b, c;
  };
  // Which part of a triangle is nearest: its corners 0 to 2, its edges 3 to 5 (edge 3 + i begins at corner
  // i), or its inside, 6. Whole numbers, as are those of triangles in order.
  struct Nearest {
    EightPlaces points;
    alignas(64) EightPlaces::Numbers squared, triangles, parts;  // squared: distances [m^2]
  };

 private:
  [[nodiscard]] Triangle triangleAt(std::size_t number) const;
  std::uint32_t build(std::size_t first, std::size_t count);
  void makePseudonormals();
  [[nodiscard]] MeshPoint meshPoint(const Nearest& nearest, std::size_t k) const;

  const SolidMesh* mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Triangle> triangles_;  // in that order
  std::vector<Node> nodes_;
  std::vector<std::array<Vec3d, 7>> pseudonormals_;
};

}  // namespace clothsim
