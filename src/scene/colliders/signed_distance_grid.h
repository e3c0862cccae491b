// A closed triangle mesh as a collider: its signed distance sampled on a grid, from which both backends
// interpolate, and the exact distance for measuring. Distances go to the nearest point of the nearest
// triangle (Ericson, Real-Time Collision Detection, 5.1.5), found in a tree of boxes; signs come from
// angle-weighted pseudonormals (Baerentzen and Aanaes, "Signed distance computation using the angle weighted
// pseudonormal", 2005).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene/budget.h"
#include "scene/colliders/collider.h"

namespace clothsim {

class TriangleTree;

struct SolidMesh {
  using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise from outside
  std::vector<Vec3d> points;                      // [m], in the collider's own frame, scaled
  std::vector<Vec3d> normals;                     // of the points, unit
  std::vector<Triangle> triangles;
};

class SignedDistanceGrid {
 public:
  // `cells` along the longest side of the mesh, with at least one more cell around it.
  SignedDistanceGrid(SolidMesh mesh, int cells);
  ~SignedDistanceGrid();

  [[nodiscard]] const SolidMesh& mesh() const { return mesh_; }
  [[nodiscard]] std::array<std::uint32_t, 3> counts() const { return counts_; }  // samples along x, y, z
  [[nodiscard]] Vec3d origin() const { return origin_; }                         // of the first sample [m]
  [[nodiscard]] double cell() const { return cell_; }                            // edge of a cell [m]
  [[nodiscard]] const std::vector<float>& samples() const { return samples_; }   // x fastest [m]
  // How many samples a grid of the mesh has, at least `cells` of them along its longest side.
  [[nodiscard]] static std::size_t sampleCount(const SolidMesh& mesh, int cells);
  // Exact, negative inside [m].
  [[nodiscard]] double distance(Vec3d p) const;

 private:
  SolidMesh mesh_;
  std::unique_ptr<TriangleTree> tree_;
  std::array<std::uint32_t, 3> counts_{};
  Vec3d origin_;
  double cell_ = 0;
  std::vector<float> samples_;
};

// Reads an OBJ file. @throws SceneError when it cannot be read, holds no triangles, or is not closed
[[nodiscard]] SolidMesh loadSolidMesh(const std::string& file, double scale);

// The grid of a collider, for each file, scale and number of cells. Computed again only when nobody holds it
// and others have been asked for that take MOST_DISTANCE_SAMPLES together. @throws SceneError as
// loadSolidMesh
[[nodiscard]] std::shared_ptr<const SignedDistanceGrid> distanceGridOf(const MeshCollider& collider);

// One a collider, null for what is no mesh. Who holds them never sees another grid in their place, whatever
// becomes of their files.
using DistanceGrids = std::vector<std::shared_ptr<const SignedDistanceGrid>>;
// @throws SceneError as loadSolidMesh, and before any is computed when they have more than `most` samples
// together
[[nodiscard]] DistanceGrids distanceGridsOf(std::span<const Collider> colliders, std::size_t most);

}  // namespace clothsim
