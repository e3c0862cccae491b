// What passes over meshes do with many elements at a time (solver/cpu/mesh_stretches.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "solver/cpu/arrays.h"
#include "solver/cpu/mesh_stretches.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/vectors.h"

namespace clothsim::cpu {

// Which elements are those of a stretch.
template <class Real>
INLINE auto stretchOf(const PassArguments<Real>& arguments, int row) {
  const Range all = rangeOf(arguments.step, row);
  return std::ranges::lower_bound(arguments.stretches.stretches, static_cast<std::uint32_t>(all.begin), {},
                                  &MeshStretches<Real>::Stretch::firstParticle);
}

template <class Real>
INLINE Vec3<Real> placeAt(const Arrays<const Real>& field, std::int32_t i) {
  return {field.x[i], field.y[i], field.z[i]};
}

// Where arrays of components have what is of element `first`.
template <class Value, std::size_t size>
INLINE auto from(std::size_t first, std::array<std::vector<Value>, size>& arrays) {
  std::array<Value*, size> result;
  for (std::size_t n = 0; n < size; ++n) result[n] = arrays[n].data() + first;
  return result;
}
template <class Value, std::size_t size>
INLINE auto from(std::size_t first, const std::array<std::vector<Value>, size>& arrays) {
  std::array<const Value*, size> result;
  for (std::size_t n = 0; n < size; ++n) result[n] = arrays[n].data() + first;
  return result;
}

// sum c_j (p_j - p_0) of the hinges from `first` on.
template <class Real>
INLINE void bendHinges(const MeshStretches<Real>& mesh, const Arrays<const Real>& p, std::size_t first,
                       std::size_t count, Real* bent) {
  const auto corners = from(first, mesh.hingeCorners);
  const auto c = from(first, mesh.coefficients);
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3<Real> origin = placeAt(p, corners[0][k]);
    putFour(
        bent, k,
        (c[0][k] * (placeAt(p, corners[1][k]) - origin) + c[1][k] * (placeAt(p, corners[2][k]) - origin)) +
            c[2][k] * (placeAt(p, corners[3][k]) - origin));
  }
}

template <class Real>
using Edges = std::array<Vec3<Real>, 3>;
using Corners = std::array<const std::int32_t*, 3>;
template <class Real>
INLINE Edges<Real> edgesAt(const Corners& corners, std::size_t k, const Arrays<const Real>& field) {
  const Vec3<Real> a = placeAt(field, corners[0][k]), b = placeAt(field, corners[1][k]),
                   c = placeAt(field, corners[2][k]);
  return {c - b, a - c, b - a};
}

template <class Real>
INLINE std::array<Real, 6> rootsAt(const std::array<const Real*, 6>& roots, std::size_t k) {
  return {roots[0][k], roots[1][k], roots[2][k], roots[3][k], roots[4][k], roots[5][k]};
}

// Room for what the elements of a stretch come to, of a thread.
template <class Real>
Real* scratchFor(const MeshStretches<Real>& mesh) {
  static thread_local std::vector<FourNumbers<Real>> room;
  room.resize(std::max({room.size(), std::size_t{mesh.mostFours}, std::size_t{1}}));
  return room.data()->numbers;
}

// How many elements a stretch has, and where the vectors lie that they come to: `bent`, of each hinge, sum
// c_j (p_j - p_0); `pulls`, of each membrane, the forces on its corners, those on all first ones before all
// second ones; `forces`, of each spring.
template <class Real>
struct ElementsOfStretch {
  using Stretch = typename MeshStretches<Real>::Stretch;
  std::size_t hinges, membranes, springs;
  Real *bent, *pulls, *forces;

  ElementsOfStretch(const Stretch& stretch, const Stretch& next, Real* scratch)
      : hinges(next.firstHinge - stretch.firstHinge),
        membranes(next.firstMembrane - stretch.firstMembrane),
        springs(next.firstSpring - stretch.firstSpring),
        bent(scratch),
        pulls(bent + 4 * hinges),
        forces(pulls + 12 * membranes) {}
};

// The forces on the corners of membrane k of `count`, whose edges pull so.
template <class Real>
INLINE void putPulls(Real* pulls, std::size_t count, std::size_t k, Vec3<Real> a, Vec3<Real> b,
                     Vec3<Real> c) {
  putFour(pulls, k, c - b);
  putFour(pulls + 4 * count, k, a - c);
  putFour(pulls + 8 * count, k, b - a);
}

// The force f on a particle, then that of hinges and that of membranes.
template <class Real>
INLINE Four<Real> withElements(const PassArguments<Real>& arguments, const ElementsOfStretch<Real>& elements,
                               std::ptrdiff_t i, Four<Real> f) {
  const MeshStretches<Real>& mesh = arguments.stretches;
  const auto &begin = arguments.lists.starts[static_cast<std::size_t>(i)],
             &end = arguments.lists.starts[static_cast<std::size_t>(i) + 1];
  for (std::uint32_t n = begin.hinges; n < end.hinges; ++n)
    f = f - mesh.hingesAt[n].coefficient * vectorAt(elements.bent, mesh.hingesAt[n].hinge);
  for (std::uint32_t n = begin.membranes - mesh.firstForce; n < end.membranes - mesh.firstForce; ++n)
    f = f + vectorAt(elements.pulls, mesh.forcesAt[n]);
  return f;
}

}  // namespace clothsim::cpu
