#pragma once

#include "scene/colliders/shape.h"
#include "scene/colliders/signed_distance_grid.h"

namespace clothsim {

// A mesh collider as the passes, measuring and drawing see it.
struct SampledMesh {
  const SignedDistanceGrid& grid;
  std::size_t firstSample;  // among those of all meshes

  template <class Params>
  void pack(Params& params, const Matrix3&) const {
    put(params.radius, grid.cell());
    put(params.gridX, grid.origin().x);
    put(params.gridY, grid.origin().y);
    put(params.gridZ, grid.origin().z);
    put(params.inverseCell, 1 / grid.cell());
    params.gridColumns = grid.counts()[0];
    params.gridRows = grid.counts()[1];
    params.gridLayers = grid.counts()[2];
    params.firstSample = static_cast<std::uint32_t>(firstSample);
  }
  [[nodiscard]] double distance(Vec3d p) const { return grid.distance(p); }
  [[nodiscard]] Surface surface(double longestEdge) const;
  [[nodiscard]] Vec3d halfExtent(const Matrix3& rotation) const;
};

}  // namespace clothsim
