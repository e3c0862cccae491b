// The colliders of a scene as the passes, measuring and drawing use them: immutable, built once from the
// scene as Cloth is, and owner of the distance grids of its meshes.
#pragma once

#include <memory>
#include <vector>

#include "scene/budget.h"
#include "scene/colliders/signed_distance_grid.h"
#include "scene/pose.h"
#include "scene/scene.h"
#include "shared/step_params.h"

namespace clothsim {

template <class Real>
using ColliderParams = shared::ColliderParams<Real>;

class ColliderSet {
 public:
  ColliderSet() = default;  // no collider
  // A grid that another set holds is shared. @throws SceneError as loadSolidMesh, and before any grid is
  // computed when all together have more than `mostSamples` samples
  explicit ColliderSet(const Scene& scene, std::size_t mostSamples = MOST_DISTANCE_SAMPLES);

  [[nodiscard]] std::size_t size() const { return colliders_.size(); }
  [[nodiscard]] const Collider& operator[](std::size_t i) const { return colliders_[i]; }

  // What a step from `begin` to `end` [s] needs of a collider.
  template <class Real>
  [[nodiscard]] ColliderParams<Real> params(std::size_t i, double begin, double end) const;
  // The samples of all distance grids, one after the other [m].
  [[nodiscard]] const std::shared_ptr<const std::vector<float>>& distances() const { return distances_; }

  // By which the own frame of a collider is rotated in the world at `time` [s].
  [[nodiscard]] Matrix3 rotationAt(std::size_t i, double time) const;
  // From a point of the own frame to the surface at `time` [s], exact, negative inside [m].
  [[nodiscard]] double distance(std::size_t i, Vec3d p, double time = 0) const;
  // In the own frame, a little smaller than the shape is, so that cloth with triangles of `longestEdge` [m]
  // does not dip below; as large as it is where that is 0. Empty for spheres and planes, which are drawn by
  // programs of their own.
  [[nodiscard]] Surface drawnSurface(std::size_t i, double longestEdge, double time = 0) const;
  // Half the sides of the axis-aligned box around a collider, whatever its shape now, whose motion has
  // rotated it so far [m]; zero for a plane.
  [[nodiscard]] Vec3d halfExtent(std::size_t i, const Matrix3& motion) const;

 private:
  template <class Use>
  decltype(auto) withSolid(std::size_t i, double time, Use use) const;

  std::vector<Collider> colliders_;
  DistanceGrids grids_;
  std::vector<std::size_t> firstSamples_;  // by collider
  std::shared_ptr<const std::vector<float>> distances_ = std::make_shared<std::vector<float>>();
  bool coulomb_ = false;
};

}  // namespace clothsim
