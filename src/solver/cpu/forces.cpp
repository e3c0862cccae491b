// The first pass of a step: springs, bending and air, gathered by each particle in a fixed order. The twin of
// shaders/sim/{forces,springs,bending,air,particle_forces}.glsl.
#include "solver/cpu/passes.h"

#include <algorithm>
#include <array>

#include "core/exact_math.h"
#include "solver/cpu/force_laws.h"
#include "solver/cpu/mesh_forces.h"
#include "solver/cpu/particle_forces.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/spring_rows.h"
#include "solver/cpu/symmetric.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {
namespace {

// Adds the forces of one incident spring to every particle of the stretch. Of owned springs it returns the
// largest bits of l^2 for the watchdog: one end of each spring is enough.
template <bool owned, bool hasCuts, class Real, class RestLengths>
INLINE auto addSpring(const PassArguments<Real>& arguments, Range particles, SpringPlace place,
                      Real stiffness, RestLengths rest) {
  const auto [bit, other] = place;
  const std::uint32_t* cutMasks = arguments.cutMasks;
  const Real *x = arguments.before.positions.x.data(), *y = arguments.before.positions.y.data(),
             *z = arguments.before.positions.z.data();
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  auto longest = bitsOf(Real(0));
  const auto add = [ =, bit = bit, other = other ](std::ptrdiff_t i) __attribute__((always_inline)) {
    const Vec3<Real> a = load(x, y, z, i), b = load(x, y, z, i + other);
    const Vec3<Real> f = springForce(a, b, stiffness, rest[i]);
    const bool isCut = isCutAt<hasCuts>(cutMasks, i, bit);
    fx[i] = isCut ? fx[i] : fx[i] + f.x;
    fy[i] = isCut ? fy[i] : fy[i] + f.y;
    fz[i] = isCut ? fz[i] : fz[i] + f.z;
    return isCut ? Real(0) : dot(b - a, b - a);
  };
  if constexpr (owned) {
#pragma GCC ivdep
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i)
      longest = larger(longest, bitsOf(add(i)));
  } else {
#pragma omp simd
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) add(i);
  }
  return longest;
}

// Particles of the row whose own springs in `slot` are too long.
template <class Real>
[[gnu::noinline, gnu::cold]] void noteOverlong(const PassArguments<Real>& arguments, Range particles,
                                               SpringPlace place, Real maxSquared) {
  const Components<Real>& p = arguments.before.positions;
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Vec3<Real> d = load(p.x.data(), p.y.data(), p.z.data(), i + place.other) -
                         load(p.x.data(), p.y.data(), p.z.data(), i);
    const bool isCut = arguments.cutMasks != nullptr && isCutAt<true>(arguments.cutMasks, i, place.bit);
    if (!isCut && isBeyond(dot(d, d), maxSquared))
      noteDivergence(arguments.watch, PASS_FORCES, i, REASON_RUNAWAY_STRAIN);
  }
}

template <bool hasCuts, class Real, class RestLengths>
INLINE void addIncidentSpring(const PassArguments<Real>& arguments, Range particles, bool owned,
                              SpringPlace place, const SpringParams<Real>& spring, RestLengths rest) {
  if (!owned) {
    addSpring<false, hasCuts>(arguments, particles, place, spring.stiffness, rest);
  } else if (addSpring<true, hasCuts>(arguments, particles, place, spring.stiffness, rest) >
             bitsOf(spring.maxLengthSquared)) {
    noteOverlong(arguments, particles, place, spring.maxLengthSquared);
  }
}

template <bool hasCuts, class Real>
INLINE void addSprings(const PassArguments<Real>& arguments, int row) {
  forEachSpringRange(
      arguments, row,
      [&](Range particles, SpringPlace place, const SpringParams<Real>& spring, auto rest)
          __attribute__((always_inline)) {
            addIncidentSpring<hasCuts>(arguments, particles, incidentSprings[place.bit].owned, place, spring,
                                       rest);
          });
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

// Three particles in a line, and the particle among them that gathers: the force on an end is b (2 m - a -
// c), that on the middle -2 times as large. Where the pins of a clamp end, the curvature of the first half
// cell shows at the last pin, half as large as it is: it counts twice. `links`: the springs, as bits of a cut
// mask, of which none may be cut.
template <bool hasCuts, class Real>
INLINE void addBendingLine(const PassArguments<Real>& arguments, Range particles, std::ptrdiff_t toA,
                           std::ptrdiff_t toM, std::ptrdiff_t toC, Real b,
                           [[maybe_unused]] std::uint32_t links) {
  [[maybe_unused]] const std::uint32_t* cutMasks = arguments.cutMasks;
  const Real *x = arguments.before.positions.x.data(), *y = arguments.before.positions.y.data(),
             *z = arguments.before.positions.z.data(), *w = arguments.inverseMasses;
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  const bool gathersInMiddle = toM == 0;
#pragma omp simd
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Vec3<Real> a = load(x, y, z, i + toA), m = load(x, y, z, i + toM), c = load(x, y, z, i + toC);
    const bool endOfClamp = w[i + toM] == Real(0) && (w[i + toA] == Real(0)) != (w[i + toC] == Real(0));
    const Real weighted = endOfClamp ? Real(2) * b : b;
    const Vec3<Real> force = weighted * ((m - a) + (m - c));
    const Vec3<Real> f{gathersInMiddle ? fx[i] - Real(2) * force.x : fx[i] + force.x,
                       gathersInMiddle ? fy[i] - Real(2) * force.y : fy[i] + force.y,
                       gathersInMiddle ? fz[i] - Real(2) * force.z : fz[i] + force.z};
    bool isCut = false;
    if constexpr (hasCuts) isCut = (cutMasks[i] & links) != 0;
    fx[i] = isCut ? fx[i] : f.x;
    fy[i] = isCut ? fy[i] : f.y;
    fz[i] = isCut ? fz[i] : f.z;
  }
}

// Along the row, all particles of which have the same border weight.
template <bool hasCuts, class Real>
INLINE void addBendingAlongRow(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  const Real b = isBorder(row, step.rows) ? Real(0.5) * step.bendAlongRow : step.bendAlongRow;
  addBendingLine<hasCuts>(arguments, rangeOf(step, row, -2, 0), -2, -1, 0, b, BENDING_LEFT);
  addBendingLine<hasCuts>(arguments, rangeOf(step, row, -1, 1), -1, 0, 1, b, BENDING_ROW);
  addBendingLine<hasCuts>(arguments, rangeOf(step, row, 0, 2), 0, 1, 2, b, BENDING_RIGHT);
}

// Along the columns through particles of the row.
template <bool hasCuts, class Real>
INLINE void addBendingAlongColumns(const PassArguments<Real>& arguments, int row, Range particles, Real b) {
  const StepParams<Real>& step = arguments.step;
  const int rows = static_cast<int>(step.rows);
  const std::ptrdiff_t one = indexOffset(step, 0, 1);
  if (row >= 2) addBendingLine<hasCuts>(arguments, particles, -2 * one, -one, 0, b, BENDING_UPPER);
  if (row >= 1 && row + 1 < rows)
    addBendingLine<hasCuts>(arguments, particles, -one, 0, one, b, BENDING_COLUMN);
  if (row + 2 < rows) addBendingLine<hasCuts>(arguments, particles, 0, one, 2 * one, b, BENDING_LOWER);
}

template <bool hasCuts, class Real>
INLINE void addBending(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  addBendingAlongRow<hasCuts>(arguments, row);
  const Range all = rangeOf(step, row);
  const Real inside = step.bendAlongColumn, halved = Real(0.5) * inside;
  const std::ptrdiff_t last = std::max(all.begin + 1, all.end - 1);
  addBendingAlongColumns<hasCuts>(arguments, row, {all.begin, all.begin + 1}, halved);
  addBendingAlongColumns<hasCuts>(arguments, row, {all.begin + 1, last}, inside);
  addBendingAlongColumns<hasCuts>(arguments, row, {last, all.end}, halved);
}

template <bool hasCuts, class Real>
INLINE void addElasticForces(const PassArguments<Real>& arguments, int row) {
  addSprings<hasCuts>(arguments, row);
  if (arguments.step.limitStiffness > Real(0)) addLimitSprings<hasCuts>(arguments, row);
  if (arguments.step.hasMaterial != 0) addBending<hasCuts>(arguments, row);
}

// With `resists` it adds up the matrices r n n^T as well.
template <bool hasCuts, bool jet, bool resists, class Real>
INLINE void addWind(const PassArguments<Real>& arguments, int row,
                    [[maybe_unused]] SymmetricField<Real>* resistance) {
  const StepParams<Real>& step = arguments.step;
  const Components<Real>&p = arguments.before.positions, &v = arguments.before.velocities;
  const Real *x = p.x.data(), *y = p.y.data(), *z = p.z.data(), *vx = v.x.data(), *vy = v.y.data(),
             *vz = v.z.data();
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
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
#pragma omp simd
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
      const bool isCut = isCutAt<hasCuts>(cutMasks, i, FIRST_CUT_TRIANGLE + k);
      const auto [f, normal, r] =
          windOn<jet>(step, interaction, load(x, y, z, i + ia), load(x, y, z, i + ib), load(x, y, z, i + ic),
                      load(vx, vy, vz, i + ia), load(vx, vy, vz, i + ib), load(vx, vy, vz, i + ic));
      fx[i] = isCut ? fx[i] : fx[i] + f.x;
      fy[i] = isCut ? fy[i] : fy[i] + f.y;
      fz[i] = isCut ? fz[i] : fz[i] + f.z;
      if constexpr (resists)
        if (!isCut) addTo(*resistance, i, outerProduct(r, normal));
    }
  }
}

template <bool resists, class Real>
INLINE void addWind(const PassArguments<Real>& arguments, int row, SymmetricField<Real>* resistance) {
  const bool hasCuts = arguments.cutMasks != nullptr;
  if (hasCuts)
    arguments.jet ? addWind<true, true, resists>(arguments, row, resistance)
                  : addWind<true, false, resists>(arguments, row, resistance);
  else
    arguments.jet ? addWind<false, true, resists>(arguments, row, resistance)
                  : addWind<false, false, resists>(arguments, row, resistance);
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
#pragma omp simd
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
  for (std::vector<Real>* f : {&arguments.forces.x, &arguments.forces.y, &arguments.forces.z})
    std::fill(f->data() + particles.begin, f->data() + particles.end, Real(0));
}

template <class Real>
INLINE void gatherForcesRow(const PassArguments<Real>& arguments, int row) {
  clearForces(arguments, row);
  if (arguments.step.isMesh != 0) {
    gatherMeshForces(arguments, row);
  } else {
    arguments.cutMasks != nullptr ? addElasticForces<true>(arguments, row)
                                  : addElasticForces<false>(arguments, row);
    if (arguments.step.hasWind != 0) addWind<false, Real>(arguments, row, nullptr);
  }
  addParticleForces(arguments, row);
}

}  // namespace

VECTOR_CLONES void gatherForces(const PassArguments<float>& arguments, int row) {
  gatherForcesRow(arguments, row);
}
void gatherForces(const PassArguments<double>& arguments, int row) { gatherForcesRow(arguments, row); }

VECTOR_CLONES void addBendingForces(const PassArguments<float>& arguments, int row) {
  arguments.cutMasks != nullptr ? addBending<true>(arguments, row) : addBending<false>(arguments, row);
}
void addBendingForces(const PassArguments<double>& arguments, int row) {
  arguments.cutMasks != nullptr ? addBending<true>(arguments, row) : addBending<false>(arguments, row);
}

template <class Real>
void gatherWind(const PassArguments<Real>& arguments, int row, SymmetricField<Real>& resistance) {
  if (arguments.step.isMesh != 0) return gatherMeshWind(arguments, row, resistance);
  clearForces(arguments, row);
  const Range particles = rangeOf(arguments.step, row);
  for (std::vector<Real>* r : resistance.all())
    std::fill(r->data() + particles.begin, r->data() + particles.end, Real(0));
  addWind<true>(arguments, row, &resistance);
}
template void gatherWind(const PassArguments<float>&, int, SymmetricField<float>&);
template void gatherWind(const PassArguments<double>&, int, SymmetricField<double>&);

}  // namespace clothsim::cpu
