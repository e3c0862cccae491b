// The first pass of a step: springs, bending and air, gathered by each particle in a fixed order. The twin of
// shaders/sim/{forces,springs,bending,air,particle_forces}.glsl.
#include "solver/cpu/passes.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/exact_math.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/force_laws.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/mesh_forces.h"
#include "solver/cpu/particle_forces.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/seam_passes.h"
#include "solver/cpu/spring_forces.h"
#include "solver/cpu/spring_rows.h"
#include "solver/cpu/symmetric.h"

namespace clothsim::cpu {
namespace {

template <class Real>
INLINE Arrays<Real> forcesOf(const PassArguments<Real>& arguments, Range particles) {
  return countedFrom(particles.begin, arraysOf(arguments.forces));
}

// What springs that are longer than limitLength add to their forces in `implicit`.
template <bool hasCuts, class Real>
INLINE void addLimitSprings(const PassArguments<Real>& arguments, int row) {
  const std::uint32_t* cutMasks = arguments.cutMasks;
  const Components<Real>& p = arguments.before.positions;
  const Real *x = p.x.data(), *y = p.y.data(), *z = p.z.data();
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  const Real stiffness = arguments.step.limitStiffness, limitFactor = arguments.step.limitFactor;
  forEachSpringRange(
      arguments, row,
      [&](Range particles, SpringPlace place, const SpringParams<Real>& spring, auto rest)
          __attribute__((always_inline)) {
            for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
              const Vec3<Real> d = load(x, y, z, i + place.other) - load(x, y, z, i);
              const Real limit = limitLength(rest, i, limitFactor, spring.limitLength);
              const Real lengthSquared = dot(d, d);
              const Real inverseLength = inverseSquareRoot(lengthSquared);
              const Real over = lengthSquared * inverseLength - limit;
              const Real scale = (stiffness * over) * inverseLength;
              const bool acts = over > Real(0) && !isCutAt<hasCuts>(cutMasks, i, place.bit);
              fx[i] = acts ? fx[i] + scale * d.x : fx[i];
              fy[i] = acts ? fy[i] + scale * d.y : fy[i];
              fz[i] = acts ? fz[i] + scale * d.z : fz[i];
            }
          });
}

// Of the bending lines whose middles m are the particles of a row, what acts on their ends: b (2 m - a - c).
// Where the pins of a clamp end, the curvature of the first half cell shows at the last pin, half as large as
// it is: it counts twice. Lines along a border count half.
template <bool hasCuts, class Real>
INLINE void computeLines(const PassArguments<Real>& arguments, std::size_t kind, int row,
                         ForceRows<Real>& rows) {
  const StepParams<Real>& step = arguments.step;
  const bool isAlongRow = kind == ForceRows<Real>::LINE_ALONG_ROW, isBorderRow = isBorder(row, step.rows);
  if (!isAlongRow && (row < 0 || row >= static_cast<int>(step.rows) || isBorderRow))
    return rows.clear(kind, row);
  const std::uint32_t* cutMasks = arguments.cutMasks;
  const Arrays<const Real> p = arraysOf(arguments.before.positions);
  const Real* w = arguments.inverseMasses;
  const Real stiffness = isAlongRow ? step.bendAlongRow : step.bendAlongColumn;
  const std::ptrdiff_t one = isAlongRow ? 1 : indexOffset(step, 0, 1);
  const std::uint32_t links = isAlongRow ? BENDING_ROW : BENDING_COLUMN;
  const Arrays<Real> forces = countedFrom(-rangeOf(step, row).begin, rows.row(kind, row));
  const auto compute = [&](Range middles, bool isEnd) __attribute__((always_inline)) {
    const Real b = isEnd || (isAlongRow && isBorderRow) ? Real(0.5) * stiffness : stiffness;
    forEachSixteen(
        middles, [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
          for (std::ptrdiff_t i = begin; i < end; ++i) {
            const Vec3<Real> a = at(p, i - one), m = at(p, i), c = at(p, i + one);
            const bool endOfClamp = w[i] == Real(0) && (w[i - one] == Real(0)) != (w[i + one] == Real(0));
            const Vec3<Real> force = (endOfClamp ? Real(2) * b : b) * ((m - a) + (m - c));
            bool isCut = false;
            if constexpr (hasCuts) isCut = (cutMasks[i] & links) != 0;
            put(forces, i, {isCut ? Real(0) : force.x, isCut ? Real(0) : force.y, isCut ? Real(0) : force.z});
          }
        });
  };
  forEachPart(isAlongRow ? rangeOf(step, row, -1, 1) : rangeOf(step, row), !isAlongRow, compute);
}

template <bool hasCuts, class Real>
INLINE void addBending(const PassArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  ensureLines(
      rows, row, [&](std::size_t kind, int middles) __attribute__((always_inline)) {
        computeLines<hasCuts>(arguments, kind, middles, rows);
      });
  const Range particles = rangeOf(arguments.step, row);
  addLines(forcesOf(arguments, particles), particles.end - particles.begin, row, rows);
}

template <bool hasCuts, class Real>
INLINE void addElasticForces(const PassArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  sumSpringForces<hasCuts>(arguments, row, forcesOf(arguments, rangeOf(arguments.step, row)), rows);
  if (arguments.step.limitStiffness > Real(0)) addLimitSprings<hasCuts>(arguments, row);
  if (arguments.step.hasMaterial != 0) addBending<hasCuts>(arguments, row, rows);
}

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
INLINE void addWind(const PassArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
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
INLINE void addParticleForces(const PassArguments<Real>& arguments, int row) {
  const Components<Real>&p = arguments.before.positions, &v = arguments.before.velocities;
  const Real *x = p.x.data(), *y = p.y.data(), *z = p.z.data(), *vx = v.x.data(), *vy = v.y.data(),
             *vz = v.z.data(), *w = arguments.inverseMasses;
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  const Range particles = rangeOf(arguments.step, row);
  forEachParticleForce(
      arguments.step, [&](auto law) __attribute__((always_inline)) {
// With a simd clause GCC 12 keeps what a law returns in memory, and the loop stays scalar.
#pragma GCC ivdep
        for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
          const Vec3<Real> f = law(load(x, y, z, i), load(vx, vy, vz, i), massOf(w[i])).force;
          fx[i] = fx[i] + f.x;
          fy[i] = fy[i] + f.y;
          fz[i] = fz[i] + f.z;
        }
      });
}

template <class Real>
INLINE void clearForces(const PassArguments<Real>& arguments, int row) {
  const Range particles = rangeOf(arguments.step, row);
  for (Component<Real>* f : {&arguments.forces.x, &arguments.forces.y, &arguments.forces.z})
    std::fill(f->data() + particles.begin, f->data() + particles.end, Real(0));
}

template <class Real>
void addExternalForces(const PassArguments<Real>& arguments, int row) {
  const Range particles = rangeOf(arguments.step, row);
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Particle4& force = arguments.externalForces[i];
    put(arguments.forces, i, at(arguments.forces, i) + Vec3f{force.x, force.y, force.z}.cast<Real>());
  }
}

template <class Real>
INLINE void gatherForcesRow(const PassArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  if (arguments.step.isMesh != 0) {
    clearForces(arguments, row);
    gatherMeshForces(arguments, row);
  } else {
    arguments.cutMasks != nullptr ? addElasticForces<true>(arguments, row, rows)
                                  : addElasticForces<false>(arguments, row, rows);
    if (arguments.step.hasWind != 0) addWind(arguments, row, rows);
  }
  addParticleForces(arguments, row);
  if (arguments.externalForces != nullptr) addExternalForces(arguments, row);
  if (hasSeams(arguments)) addSeamForces(arguments, row);
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

VECTOR_CLONES(void, gatherForces, (const PassArguments<float>& arguments, int row, ForceRows<float>& rows),
              (arguments, row, rows), gatherForcesRow(arguments, row, rows))
void gatherForces(const PassArguments<double>& arguments, int row, ForceRows<double>& rows) {
  gatherForcesRow(arguments, row, rows);
}

VECTOR_CLONES(void, gatherWind,
              (const PassArguments<float>& arguments, int row, SymmetricField<float>& resistance),
              (arguments, row, resistance), gatherWindRow(arguments, row, resistance))
void gatherWind(const PassArguments<double>& arguments, int row, SymmetricField<double>& resistance) {
  gatherWindRow(arguments, row, resistance);
}

}  // namespace clothsim::cpu
