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

// Triangles in a tree of bounding boxes, halved at the median of their middles.
class TriangleTree {
 public:
  explicit TriangleTree(const SolidMesh& mesh);  // which must outlive it

  // Negative inside [m]. `bound`: more than the distance is, where that is known, saves time.
  [[nodiscard]] double signedDistance(Vec3d p, double bound = 1e150) const;
  // The nearest one.
  [[nodiscard]] MeshPoint nearestPoint(Vec3d p, double bound = 1e150) const;

 private:
  struct Node {
    Vec3d low, high;
    std::size_t first = 0, count = 0;  // of order_, in a leaf
    std::size_t left = 0, right = 0;   // nodes, elsewhere
  };
  // Which part of a triangle is nearest: its corners 0 to 2, its edges 3 to 5 (edge 3 + i begins at corner
  // i), or its inside, 6.
  struct NearestPlace {
    Vec3d point;
    int part = 6;
  };
  struct Best {
    double squared = 1e300;
    std::size_t triangle = 0;
    NearestPlace place;
  };

  [[nodiscard]] static NearestPlace nearestOnTriangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c);
  [[nodiscard]] std::array<Vec3d, 3> corners(std::size_t triangle) const;
  std::size_t build(std::size_t first, std::size_t count);
  [[nodiscard]] static double squaredTo(const Node& node, Vec3d p);
  void search(std::size_t index, Vec3d p, Best& best) const;
  void makePseudonormals();

  const SolidMesh* mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::vector<std::array<Vec3d, 7>> pseudonormals_;
};

}  // namespace clothsim
