#pragma once

#include "scene/colliders/shape.h"
#include "scene/colliders/signed_distance_grid.h"

namespace clothsim {

// A mesh collider as the passes, measuring and drawing see it.
struct SampledMesh {
  const SignedDistanceGrid& grid;
  std::size_t firstSample;  // among those of all meshes
  ShapeMoment moment;       // of a body that deforms

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
    params.firstSample = static_cast<std::uint32_t>(firstSample + grid.firstOfShape(moment.from));
    params.nextSample = static_cast<std::uint32_t>(firstSample + grid.firstOfShape(moment.to));
  }
  // The way that a body is on at the end of a step, and the one that it is on in its middle, of which it goes
  // the part `share` in the step.
  template <class Params>
  void packWays(Params& params, const ShapeMoment& middle, double share) const {
    put(params.part, moment.part);
    put(params.share, share);
    params.way = static_cast<std::uint32_t>(firstSample + grid.firstOfWay(moment.from));
    params.middleWay = static_cast<std::uint32_t>(firstSample + grid.firstOfWay(middle.from));
  }
  [[nodiscard]] double distance(Vec3d p) const { return grid.distance(p, moment); }
  [[nodiscard]] Surface surface(double longestEdge) const;
  [[nodiscard]] Vec3d halfExtent(const Matrix3& rotation) const;
};

}  // namespace clothsim
