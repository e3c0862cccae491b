// A closed triangle mesh as a collider: its signed distance sampled on a grid, from which both backends
// interpolate, and the exact distance for measuring. A body that deforms has a grid for each of its shapes,
// all in one box, and for the way from each to the next how far the nearest place of the surface goes,
// sampled on a grid of half as many points along x, y and z.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "scene/budget.h"
#include "scene/colliders/collider.h"
#include "scene/colliders/enclosing.h"
#include "scene/colliders/triangle_tree.h"

namespace clothsim {

// Exact distances of a mesh.
struct MeasuredMesh {
  explicit MeasuredMesh(SolidMesh shape) : mesh(std::move(shape)), tree(mesh) {}
  MeasuredMesh(const MeasuredMesh&) = delete;
  MeasuredMesh& operator=(const MeasuredMesh&) = delete;
  SolidMesh mesh;
  TriangleTree tree;
};

class SignedDistanceGrid {
 public:
  // `cells` along the longest side of the mesh, with at least one more cell around it.
  SignedDistanceGrid(SolidMesh mesh, int cells);
  // Of shapes with the same triangles; `loops`: there is a way from the last one to the first.
  SignedDistanceGrid(std::vector<SolidMesh> shapes, bool loops, int cells);

  [[nodiscard]] const SolidMesh& mesh() const { return shapes_.front(); }
  [[nodiscard]] const std::vector<SolidMesh>& shapes() const { return shapes_; }
  [[nodiscard]] std::array<std::uint32_t, 3> counts() const { return counts_; }  // samples along x, y, z
  [[nodiscard]] Vec3d origin() const { return origin_; }                         // of the first sample [m]
  [[nodiscard]] double cell() const { return cell_; }                            // edge of a cell [m]
  // Shape after shape, x fastest; then for each way the components of displacements [m].
  [[nodiscard]] const std::vector<float>& samples() const { return samples_; }
  [[nodiscard]] std::size_t firstOfShape(std::size_t shape) const { return shape * samplesOfShape(); }
  [[nodiscard]] std::size_t firstOfWay(std::size_t way) const;
  // How many samples grids of the shapes have, at least `cells` of them along the longest side.
  [[nodiscard]] static std::size_t sampleCount(std::span<const SolidMesh> shapes, bool loops, int cells);

  // The mesh at a moment.
  [[nodiscard]] std::shared_ptr<const MeasuredMesh> at(const ShapeMoment& moment) const;
  // Exact, negative inside [m].
  [[nodiscard]] double distance(Vec3d p, const ShapeMoment& moment = {}) const;

 private:
  [[nodiscard]] std::size_t samplesOfShape() const;
  [[nodiscard]] SampleGrid grid() const;
  [[nodiscard]] SampleGrid gridOfDisplacements() const;
  void sampleDistances(const SolidMesh& shape, float* samples) const;
  void sampleRoughly(const SolidMesh& shape, float* samples) const;
  void enclose(std::size_t ways);
  void sampleDisplacements(const SolidMesh& from, const SolidMesh& to, float* samples) const;

  std::vector<SolidMesh> shapes_;
  std::array<std::uint32_t, 3> counts_{};
  Vec3d origin_;
  double cell_ = 0;
  std::vector<float> samples_;
  // The moment that was asked for last.
  mutable std::mutex mutex_;
  mutable ShapeMoment lastMoment_;
  mutable std::shared_ptr<const MeasuredMesh> last_;
};

// The grid of a collider, for each file, scale and number of cells, and whatever tells its shapes. Computed
// again only when nobody holds it and others have been asked for that take MOST_DISTANCE_SAMPLES together.
// @throws SceneError as loadSolidMesh
[[nodiscard]] std::shared_ptr<const SignedDistanceGrid> distanceGridOf(const MeshCollider& collider);

// One a collider, null for what is no mesh. Who holds them never sees another grid in their place, whatever
// becomes of their files.
using DistanceGrids = std::vector<std::shared_ptr<const SignedDistanceGrid>>;
// @throws SceneError as loadSolidMesh, and before any is computed when they have more than `most` samples
// together
[[nodiscard]] DistanceGrids distanceGridsOf(std::span<const Collider> colliders, std::size_t most);

}  // namespace clothsim
