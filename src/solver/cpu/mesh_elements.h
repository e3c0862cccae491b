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

// What a stretch's vertices have of a field, as vectors of four.
template <class Real>
INLINE void putVertices(const MeshStretches<Real>& mesh, const typename MeshStretches<Real>::Stretch& stretch,
                        std::uint32_t end, const Arrays<const Real>& field, Real* vertices) {
  const std::uint32_t *particles = mesh.vertices.data() + stretch.firstVertex,
                      count = end - stretch.firstVertex;
#pragma GCC ivdep
  for (std::uint32_t k = 0; k < count; ++k)
    putFour(vertices, k, at(field, static_cast<std::ptrdiff_t>(particles[k])));
}

// sum c_j (p_j - p_0) of the hinges from `first` on, p those of the vertices.
template <class Real>
INLINE void bendHinges(const MeshStretches<Real>& mesh, const Real* vertices, std::size_t first,
                       std::size_t count, Real* bent) {
  const auto corners = from(first, mesh.hingeCorners);
  const auto c = from(first, mesh.coefficients);
  auto* sums = reinterpret_cast<Four<Real>*>(bent);
  for (std::size_t k = 0; k < count; ++k) {
    const Four<Real> origin = vectorAt(vertices, corners[0][k]);
    sums[k] = (c[0][k] * (vectorAt(vertices, corners[1][k]) - origin) +
               c[1][k] * (vectorAt(vertices, corners[2][k]) - origin)) +
              c[2][k] * (vectorAt(vertices, corners[3][k]) - origin);
  }
}

// Some of the vertices, by component.
inline constexpr std::size_t AT_ONCE = 64;
template <class Real>
struct SomeVertices {
  alignas(64) Real x[AT_ONCE], y[AT_ONCE], z[AT_ONCE];

  INLINE void gather(const Real* vertices, const std::uint32_t* numbers, std::size_t count) {
    gatherFours(
        vertices, static_cast<std::ptrdiff_t>(count),
        [&](std::ptrdiff_t k) __attribute__((always_inline)) { return std::size_t{numbers[k]}; }, x, y, z);
  }
  [[nodiscard]] INLINE Vec3<Real> at(std::size_t k) const { return {x[k], y[k], z[k]}; }
};

template <class Real>
using Edges = std::array<Vec3<Real>, 3>;
// The corners of some membranes.
template <class Real>
struct SomeCorners {
  SomeVertices<Real> of[3];

  [[nodiscard]] INLINE Edges<Real> edgesAt(std::size_t k) const {
    const Vec3<Real> a = of[0].at(k), b = of[1].at(k), c = of[2].at(k);
    return {c - b, a - c, b - a};
  }
};
// Calls work(begin, count, corners) for the membranes from `first` on, AT_ONCE at a time: from first + begin
// on.
template <class Real, class Work>
INLINE void forSomeMembranes(const MeshStretches<Real>& mesh, const Real* vertices, std::size_t first,
                             std::size_t count, Work work) {
  const auto numbers = from(first, mesh.membraneCorners);
  SomeCorners<Real> corners;
  for (std::size_t begin = 0; begin < count; begin += AT_ONCE) {
    const std::size_t some = std::min(AT_ONCE, count - begin);
    for (std::size_t k = 0; k < 3; ++k) corners.of[k].gather(vertices, numbers[k] + begin, some);
    work(begin, some, corners);
  }
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

// How many elements a stretch has, and where the vectors of its vertices lie, and those that elements come
// to: `bent`, of each hinge, sum c_j (p_j - p_0); `pulls`, of each membrane, the forces on its corners, those
// on all first ones before all second ones; `forces`, of each spring.
template <class Real>
struct ElementsOfStretch {
  using Stretch = typename MeshStretches<Real>::Stretch;
  std::size_t hinges, membranes, springs;
  Real *vertices, *bent, *pulls, *forces;

  ElementsOfStretch(const Stretch& stretch, const Stretch& next, Real* scratch)
      : hinges(next.firstHinge - stretch.firstHinge),
        membranes(next.firstMembrane - stretch.firstMembrane),
        springs(next.firstSpring - stretch.firstSpring),
        vertices(scratch),
        bent(vertices + 4 * (next.firstVertex - stretch.firstVertex)),
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
  const auto particle = static_cast<std::size_t>(i);
  for (std::uint32_t n = mesh.elementStarts[particle]; n < mesh.elementStarts[particle + 1]; ++n)
    f = f + mesh.elementsAt[n].coefficient * vectorAt(elements.bent, mesh.elementsAt[n].place);
  return f;
}

}  // namespace clothsim::cpu
