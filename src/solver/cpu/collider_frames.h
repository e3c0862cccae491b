// Colliders' own frames, their motion, and boxes around them; the twin of shaders/sim/collider_frames.glsl.
#pragma once

#include <algorithm>

#include "core/exact_math.h"
#include "core/vec.h"
#include "shared/shapes.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/rows.h"
#include "solver/step_params.h"

namespace clothsim::cpu {

template <class Real>
INLINE Vec3<Real> pointOf(const ColliderParams<Real>& collider) {
  return {collider.pointX, collider.pointY, collider.pointZ};
}

// x after a rigid motion: of a moving collider over the step, of pins since the start.
template <class Motion, class Real>
INLINE Vec3<Real> carried(const Motion& motion, Vec3<Real> x) {
  const Vec3<Real> d = x - Vec3<Real>{motion.pivotX, motion.pivotY, motion.pivotZ};
  const Vec3<Real> rotated{dot({motion.rotationXX, motion.rotationXY, motion.rotationXZ}, d),
                           dot({motion.rotationYX, motion.rotationYY, motion.rotationYZ}, d),
                           dot({motion.rotationZX, motion.rotationZY, motion.rotationZZ}, d)};
  const Vec3<Real> move = rotated + Vec3<Real>{motion.translationX, motion.translationY, motion.translationZ};
  return x + move;
}

// Components below 2^-40 are 0, so that their squares are no denormals.
template <class Real>
INLINE Vec3<Real> toOwnFrame(const ColliderParams<Real>& shape, Vec3<Real> x) {
  const Vec3<Real> d = x - pointOf(shape);
  return {canonical(dot({shape.axisXX, shape.axisXY, shape.axisXZ}, d)),
          canonical(dot({shape.axisYX, shape.axisYY, shape.axisYZ}, d)),
          canonical(dot({shape.axisZX, shape.axisZY, shape.axisZZ}, d))};
}
template <class Real>
INLINE Vec3<Real> toWorld(const ColliderParams<Real>& shape, Vec3<Real> v) {
  const Vec3<Real> x{shape.axisXX, shape.axisXY, shape.axisXZ}, y{shape.axisYX, shape.axisYY, shape.axisYZ},
      z{shape.axisZX, shape.axisZY, shape.axisZZ};
  return (v.x * x + v.y * y) + v.z * z;
}

// A box around a collider, along the axes of its frame. Most particles are farther from it than they move in
// a step. That is quickly seen; the distance from the shape itself takes long to work out.
template <class Real>
struct ColliderBox {
  Vec3<Real> center, halfSize;

  explicit ColliderBox(const ColliderParams<Real>& c) : center{}, halfSize{} {
    const Real r = c.radius, everywhere = Real(1e18);
    switch (c.type) {
      case COLLIDER_SPHERE:
        halfSize = {r, r, r};
        return;
      case COLLIDER_CAPSULE:
        halfSize = {r, c.sizeY + r, r};
        return;
      case COLLIDER_BOX:
        halfSize = {c.sizeX + r, c.sizeY + r, c.sizeZ + r};
        return;
      case COLLIDER_TORUS:
        halfSize = {c.sizeX + r, r, c.sizeX + r};
        return;
      case COLLIDER_CYLINDER:
        halfSize = {r, c.sizeY, r};
        return;
      case COLLIDER_CONE:
        halfSize = {std::max(c.sizeX, c.sizeZ), c.sizeY, std::max(c.sizeX, c.sizeZ)};
        return;
      case COLLIDER_MESH:
        // Its grid of distances. A body that deforms has no box: how far it carries particles is not known.
        if (c.way == 0) {
          const Real half = Real(0.5) * reciprocal(c.inverseCell);
          halfSize = {half * Real(c.gridColumns - 1), half * Real(c.gridRows - 1),
                      half * Real(c.gridLayers - 1)};
          center = Vec3<Real>{c.gridX, c.gridY, c.gridZ} + halfSize;
          return;
        }
        [[fallthrough]];
      default:
        halfSize = {everywhere, everywhere, everywhere};
    }
  }

  // Whether a particle that comes from `start` to `x` in the step is certainly farther from the collider than
  // `margin`, and was so all the way. [m]
  INLINE bool isFarFrom(const ColliderParams<Real>& collider, bool moving, Vec3<Real> start, Vec3<Real> x,
                        Real margin) const {
    const auto size = [](Real a) __attribute__((always_inline)) { return a < Real(0) ? -a : a; };
    const Vec3<Real> place = toOwnFrame(collider, x);
    // By component: a copy of a struct that lies in memory keeps the loop scalar.
    const Vec3<Real> p{place.x - center.x, place.y - center.y, place.z - center.z};
    const Vec3<Real> moved = x - selected(moving, carried(collider, start), start);
    const Real beyondX = size(p.x) - halfSize.x, beyondY = size(p.y) - halfSize.y,
               beyondZ = size(p.z) - halfSize.z;
    const Real beyond = larger(larger(beyondX, beyondY), beyondZ);
    // What rounding may have made of a place so far from the origin is taken off.
    const Real rounding = Real(0x1p-14) * ((size(p.x) + size(p.y)) + size(p.z));
    const Real distance = beyond - rounding;
    return (margin < distance) & (dot(moved, moved) < Real(0.98) * (distance * distance));
  }
};

// Calls work(particles) for stretches of up to sixteen in which the box does not tell all to be far; `places`
// is where they come.
template <class Real, class Work>
INLINE void forEachNear(const ColliderParams<Real>& of, const Components<Real>& starts,
                        const Components<Real>& places, Range particles, Real margin, Work work) {
  const ColliderParams<Real> collider = of;  // which no store to a particle changes
  const ColliderBox<Real> box(collider);
  const bool moving = collider.moving != 0;
  const Arrays<const Real> x = arraysOf(places), x0 = arraysOf(starts);
  std::uint32_t near[MESH_ROW];
  for (std::ptrdiff_t chunk = particles.begin; chunk < particles.end; chunk += MESH_ROW) {
    const Range all{chunk, std::min(chunk + MESH_ROW, particles.end)};
    forEachSixteen(
        all, [&](std::ptrdiff_t first, std::ptrdiff_t last) __attribute__((always_inline)) {
#pragma GCC ivdep
          for (std::ptrdiff_t i = first; i < last; ++i)
            near[i - chunk] = box.isFarFrom(collider, moving, at(x0, i), at(x, i), margin) ? 0u : 1u;
        });
    for (std::ptrdiff_t begin = chunk; begin < all.end; begin += SIXTEEN) {
      const Range some{begin, std::min(begin + SIXTEEN, all.end)};
      std::uint32_t any = 0;
      for (std::ptrdiff_t i = some.begin; i < some.end; ++i) any |= near[i - chunk];
      if (any != 0) work(some);
    }
  }
}

}  // namespace clothsim::cpu
