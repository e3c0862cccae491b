#include "solver/cpu/wind_forces.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/exact_math.h"
#include "core/vector_clones.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/force_laws.h"
#include "solver/cpu/mesh_forces.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

// The wind on the triangles of the cells of a row: a corner at (c, r), or at (c + 1, r + 1).
template <bool hasCuts, bool jet, class Real>
INLINE void computeWind(const PassArguments<Real>& arguments, std::size_t kind, int row,
                        ForceRows<Real>& rows) {
  const StepParams<Real>& step = arguments.step;
  if (row < 0 || row + 1 >= static_cast<int>(step.rows)) return rows.clear(kind, row);
  const bool isUpper = kind == ForceRows<Real>::UPPER_TRIANGLE;
  const Arrays<const Real> p = arraysOf(arguments.before.positions),
                           v = arraysOf(arguments.before.velocities);
  const Real *x = p.x, *y = p.y, *z = p.z, *vx = v.x, *vy = v.y, *vz = v.z;
  const auto& [a, b, c] = incidentTriangles[isUpper ? 5 : 0];
  const int down = isUpper ? 0 : 1;  // from the cell to the particle that incidentTriangles starts at
  const auto offset = [&](Corner corner) {
    return indexOffset(step, corner.columns + down, corner.rows + down);
  };
  const std::ptrdiff_t ia = offset(a), ib = offset(b), ic = offset(c);
  const Range cells = rangeOf(step, row, 0, 1);
  const InteractionParams<Real>& interaction = arguments.interaction;
  // The mask of (c, r), or of (c, r + 1), whose third triangle the second of a cell is.
  const std::uint32_t* cutMasks =
      hasCuts ? arguments.cutMasks + (isUpper ? 0 : indexOffset(step, 0, 1)) : nullptr;
  const std::uint32_t bit = FIRST_CUT_TRIANGLE + (isUpper ? 5 : 2);
  const Arrays<Real> forces = rows.row(kind, row);
  Real *fx = forces.x - cells.begin, *fy = forces.y - cells.begin, *fz = forces.z - cells.begin;
  forEachSixteen(
      cells, [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma omp simd
        for (std::ptrdiff_t i = begin; i < end; ++i) {
          const bool isCut = isCutAt<hasCuts>(cutMasks, i, bit);
          const auto [f, normal, r] = windOn<jet>(
              step, interaction, load(x, y, z, i + ia), load(x, y, z, i + ib), load(x, y, z, i + ic),
              load(vx, vy, vz, i + ia), load(vx, vy, vz, i + ib), load(vx, vy, vz, i + ic));
          fx[i] = isCut ? Real(0) : f.x;
          fy[i] = isCut ? Real(0) : f.y;
          fz[i] = isCut ? Real(0) : f.z;
        }
      });
}

// In the order of incidentTriangles.
template <bool hasCuts, bool jet, class Real>
INLINE void addWind(const PassArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  constexpr std::size_t upper = ForceRows<Real>::UPPER_TRIANGLE, lower = ForceRows<Real>::LOWER_TRIANGLE;
  for (const std::size_t kind : {upper, lower})
    rows.ensure(
        kind, row - 1, row, [&](int cells) __attribute__((always_inline)) {
          computeWind<hasCuts, jet>(arguments, kind, cells, rows);
        });
  const Range particles = rangeOf(arguments.step, row);
  const Arrays<Real> forces = forcesOf(arguments, particles);
  const auto term = [&](std::size_t kind, int cells, std::ptrdiff_t shift) __attribute__((always_inline)) {
    return Term<Real>{rows.row(kind, cells), shift};
  };
  addTerms<true, true, true, true, true, true>(
      forces, forces, particles.end - particles.begin,
      std::array<Term<Real>, 6>{term(lower, row - 1, -1), term(upper, row - 1, 0), term(lower, row - 1, 0),
                                term(upper, row, -1), term(lower, row, -1), term(upper, row, 0)},
      std::make_index_sequence<6>());
}

template <class Real>
INLINE void addWindRow(const PassArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  if (arguments.cutMasks != nullptr)
    arguments.jet ? addWind<true, true>(arguments, row, rows) : addWind<true, false>(arguments, row, rows);
  else
    arguments.jet ? addWind<false, true>(arguments, row, rows) : addWind<false, false>(arguments, row, rows);
}

// The wind on the triangles at each particle, and the matrices r n n^T by which they resist.
template <bool hasCuts, bool jet, class Real>
INLINE void addResistingWind(const PassArguments<Real>& arguments, int row,
                             const SymmetricArrays<Real>& resistance) {
  const StepParams<Real>& step = arguments.step;
  const Arrays<const Real> p = arraysOf(arguments.before.positions),
                           v = arraysOf(arguments.before.velocities);
  const Arrays<Real> forces = arraysOf(arguments.forces);
  const std::uint32_t* cutMasks = arguments.cutMasks;
  const InteractionParams<Real>& interaction = arguments.interaction;
  for (std::uint32_t k = 0; k < incidentTriangles.size(); ++k) {
    const auto& [a, b, c] = incidentTriangles[k];
    const auto [firstRow, lastRow] = std::minmax({a.rows, b.rows, c.rows});
    if (row + firstRow < 0 || row + lastRow >= static_cast<int>(step.rows)) continue;
    const auto [firstColumn, lastColumn] = std::minmax({a.columns, b.columns, c.columns});
    const Range particles = rangeOf(step, row, firstColumn, lastColumn);
    const std::ptrdiff_t ia = indexOffset(step, a.columns, a.rows), ib = indexOffset(step, b.columns, b.rows),
                         ic = indexOffset(step, c.columns, c.rows);
#pragma GCC ivdep
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
      const bool isCut = isCutAt<hasCuts>(cutMasks, i, FIRST_CUT_TRIANGLE + k);
      const TriangleWind<Real> wind = windOn<jet>(step, interaction, at(p, i + ia), at(p, i + ib),
                                                  at(p, i + ic), at(v, i + ia), at(v, i + ib), at(v, i + ic));
      const Vec3<Real> before = at(forces, i), f = before + wind.force;
      put(forces, i, {isCut ? before.x : f.x, isCut ? before.y : f.y, isCut ? before.z : f.z});
      put(resistance, i, at(resistance, i) + outerProduct(isCut ? Real(0) : wind.resistance, wind.normal));
    }
  }
}

template <class Real>
INLINE void gatherWindRow(const PassArguments<Real>& arguments, int row, SymmetricField<Real>& resistance) {
  if (arguments.step.isMesh != 0) return gatherMeshWind(arguments, row, resistance);
  clearForces(arguments, row);
  const Range particles = rangeOf(arguments.step, row);
  for (std::vector<Real>* r : resistance.all())
    std::fill(r->data() + particles.begin, r->data() + particles.end, Real(0));
  const SymmetricArrays<Real> to = arraysOf(resistance);
  const bool hasCuts = arguments.cutMasks != nullptr;
  if (hasCuts)
    arguments.jet ? addResistingWind<true, true>(arguments, row, to)
                  : addResistingWind<true, false>(arguments, row, to);
  else
    arguments.jet ? addResistingWind<false, true>(arguments, row, to)
                  : addResistingWind<false, false>(arguments, row, to);
}

}  // namespace

VECTOR_CLONES(void, addWind, (const PassArguments<float>& arguments, int row, ForceRows<float>& rows),
              (arguments, row, rows), addWindRow(arguments, row, rows))
void addWind(const PassArguments<double>& arguments, int row, ForceRows<double>& rows) {
  addWindRow(arguments, row, rows);
}

VECTOR_CLONES(void, gatherWind,
              (const PassArguments<float>& arguments, int row, SymmetricField<float>& resistance),
              (arguments, row, resistance), gatherWindRow(arguments, row, resistance))
void gatherWind(const PassArguments<double>& arguments, int row, SymmetricField<double>& resistance) {
  gatherWindRow(arguments, row, resistance);
}

}  // namespace clothsim::cpu
