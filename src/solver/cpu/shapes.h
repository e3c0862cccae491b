// Signed distances of the colliders' shapes in their own frames; the twin of shaders/sim/shapes.glsl. All are
// exact, inside as well as outside (formulas as in Inigo Quilez, "Distance functions", with the box's and the
// torus' normals worked out by hand).
#pragma once

#include "core/exact_math.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

// The nearest place of a surface, seen from a point.
template <class Real>
struct Nearest {
  Real distance;      // [m], negative inside
  Vec3<Real> normal;  // outward there
};

template <class Real>
INLINE Vec3<Real> select(bool which, Vec3<Real> a, Vec3<Real> b) {
  return {which ? a.x : b.x, which ? a.y : b.y, which ? a.z : b.z};
}

// All points within `radius` of the segment from (0, -sizeY, 0) to (0, sizeY, 0).
template <class Real>
INLINE Nearest<Real> nearestOnCapsule(const ColliderParams<Real>& capsule, Vec3<Real> p) {
  const Real half = capsule.sizeY;
  const Real above = half < p.y ? half : p.y;
  const Real y = above < -half ? -half : above;
  const Vec3<Real> d{p.x, p.y - y, p.z};
  const Real lengthSquared = dot(d, d);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  return {lengthSquared * inverseLength - capsule.radius, inverseLength * d};
}

// All points within `radius` of the box with corners (+-sizeX, +-sizeY, +-sizeZ).
template <class Real>
INLINE Nearest<Real> nearestOnBox(const ColliderParams<Real>& box, Vec3<Real> p) {
  const Vec3<Real> magnitude{p.x < Real(0) ? -p.x : p.x, p.y < Real(0) ? -p.y : p.y,
                             p.z < Real(0) ? -p.z : p.z};
  const Vec3<Real> beyond = magnitude - Vec3<Real>{box.sizeX, box.sizeY, box.sizeZ};
  const bool beyondX = Real(0) < beyond.x, beyondY = Real(0) < beyond.y, beyondZ = Real(0) < beyond.z;
  const bool outside = beyondX | beyondY | beyondZ;
  const Vec3<Real> d{beyondX ? beyond.x : Real(0), beyondY ? beyond.y : Real(0),
                     beyondZ ? beyond.z : Real(0)};
  const Real lengthSquared = dot(d, d);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Vec3<Real> outward = inverseLength * d;
  // Within the inner box the nearest face counts.
  const bool faceX = !(beyond.x < beyond.y) & !(beyond.x < beyond.z);
  const bool faceY = !faceX & !(beyond.y < beyond.z);
  const bool faceZ = !faceX & !faceY;
  const Real toFace = faceX ? beyond.x : faceY ? beyond.y : beyond.z;
  const Real distance = outside ? lengthSquared * inverseLength : toFace;
  const Vec3<Real> normal =
      select(outside, outward,
             Vec3<Real>{faceX ? Real(1) : Real(0), faceY ? Real(1) : Real(0), faceZ ? Real(1) : Real(0)});
  return {distance - box.radius,
          Vec3<Real>{p.x < Real(0) ? -normal.x : normal.x, p.y < Real(0) ? -normal.y : normal.y,
                     p.z < Real(0) ? -normal.z : normal.z}};
}

// All points within `radius` of the circle of radius sizeX about y.
template <class Real>
INLINE Nearest<Real> nearestOnTorus(const ColliderParams<Real>& torus, Vec3<Real> p) {
  const Real axisSquared = p.x * p.x + p.z * p.z;
  const Real inverseAxis = inverseSquareRoot(axisSquared);
  const Real beyond = axisSquared * inverseAxis - torus.sizeX;
  const Real lengthSquared = beyond * beyond + p.y * p.y;
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real radial = (beyond * inverseLength) * inverseAxis;
  return {lengthSquared * inverseLength - torus.radius,
          Vec3<Real>{radial * p.x, inverseLength * p.y, radial * p.z}};
}

// One coordinate in a grid of `count` samples: the cell, and the place in it from 0 to 1.
template <class Real>
struct GridPlace {
  std::uint32_t cell;
  Real part;
};
template <class Real>
INLINE GridPlace<Real> gridPlace(Real within, std::uint32_t count) {
  const auto truncated = static_cast<std::uint32_t>(static_cast<std::int32_t>(within));
  const std::uint32_t cell = truncated < count - 2 ? truncated : count - 2;
  return {cell, within - static_cast<Real>(static_cast<std::int32_t>(cell))};
}

template <class Real>
INLINE Real clampedTo(Real x, Real high) {
  const Real above = x < Real(0) ? Real(0) : x;
  return high < above ? high : above;
}

// A mesh by its sampled distance: trilinear inside the grid, with the gradient of that as normal. Outside, no
// more than what is known there: the mesh is at least a cell inside the grid.
template <class Real>
INLINE Nearest<Real> nearestOnMesh(const ColliderParams<Real>& mesh, const float* distances, Vec3<Real> p) {
  const Vec3<Real> q = mesh.inverseCell * (p - Vec3<Real>{mesh.gridX, mesh.gridY, mesh.gridZ});
  const auto last = [](std::uint32_t count) {
    return static_cast<Real>(static_cast<std::int32_t>(count - 1));
  };
  const Vec3<Real> within{clampedTo(q.x, last(mesh.gridColumns)), clampedTo(q.y, last(mesh.gridRows)),
                          clampedTo(q.z, last(mesh.gridLayers))};
  const Vec3<Real> d{canonical(q.x - within.x), canonical(q.y - within.y), canonical(q.z - within.z)};
  const Real beyondSquared = dot(d, d);
  const GridPlace<Real> x = gridPlace(within.x, mesh.gridColumns), y = gridPlace(within.y, mesh.gridRows),
                        z = gridPlace(within.z, mesh.gridLayers);
  const std::uint32_t first =
      mesh.firstSample + (z.cell * mesh.gridRows + y.cell) * mesh.gridColumns + x.cell;
  const std::uint32_t layer = mesh.gridColumns * mesh.gridRows;
  const auto sample = [&](std::uint32_t offset) { return static_cast<Real>(distances[first + offset]); };
  const Real s00 = sample(0), s10 = sample(mesh.gridColumns), s01 = sample(layer),
             s11 = sample(layer + mesh.gridColumns);
  const Real x00 = sample(1) - s00, x10 = sample(mesh.gridColumns + 1) - s10, x01 = sample(layer + 1) - s01,
             x11 = sample(layer + mesh.gridColumns + 1) - s11;
  const Real v00 = s00 + x.part * x00, v10 = s10 + x.part * x10, v01 = s01 + x.part * x01,
             v11 = s11 + x.part * x11;
  const Real y0 = v10 - v00, y1 = v11 - v01;
  const Real v0 = v00 + y.part * y0, v1 = v01 + y.part * y1;
  const Real z0 = v1 - v0;
  const Real x0 = x00 + y.part * (x10 - x00), x1 = x01 + y.part * (x11 - x01);
  const Vec3<Real> gradient{canonical(x0 + z.part * (x1 - x0)), canonical(y0 + z.part * (y1 - y0)),
                            canonical(z0)};
  const bool beyond = Real(0) < beyondSquared;
  const Vec3<Real> direction = select(beyond, d, gradient);
  const Real lengthSquared = dot(direction, direction);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real away = mesh.radius * (lengthSquared * inverseLength + Real(1));
  const Real interpolated = v0 + z.part * z0;
  return {beyond ? away : interpolated, inverseLength * direction};
}

template <std::uint32_t type, class Real>
INLINE Nearest<Real> nearestOnShape(const ColliderParams<Real>& shape, Vec3<Real> p,
                                    const float* distances = nullptr) {
  if constexpr (type == COLLIDER_CAPSULE) {
    return nearestOnCapsule(shape, p);
  } else if constexpr (type == COLLIDER_BOX) {
    return nearestOnBox(shape, p);
  } else if constexpr (type == COLLIDER_MESH) {
    return nearestOnMesh(shape, distances, p);
  } else {
    return nearestOnTorus(shape, p);
  }
}

}  // namespace clothsim::cpu
