// The first pass of a step: what acts on each particle, gathered in a fixed order. The twin of
// shaders/sim/{forces,springs,bending,particle_forces}.glsl.
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
#include "solver/cpu/wind_forces.h"

namespace clothsim::cpu {
namespace {

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
#pragma GCC ivdep
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

}  // namespace

VECTOR_CLONES(void, gatherForces, (const PassArguments<float>& arguments, int row, ForceRows<float>& rows),
              (arguments, row, rows), gatherForcesRow(arguments, row, rows))
void gatherForces(const PassArguments<double>& arguments, int row, ForceRows<double>& rows) {
  gatherForcesRow(arguments, row, rows);
}

}  // namespace clothsim::cpu
