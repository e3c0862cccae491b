#include "solver/cpu/passes.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "core/exact_math.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {
namespace {

// Hooke's law: k (l - L) along the unit vector from a to b.
template <class Real>
INLINE Vec3<Real> springForce(Vec3<Real> a, Vec3<Real> b, Real stiffness, Real restLength) {
  const Vec3<Real> d = b - a;
  const Real lengthSquared = dot(d, d);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real length = lengthSquared * inverseLength;
  const Real scale = (stiffness * (length - restLength)) * inverseLength;
  return scale * d;
}

// What of the jet arrives at x, 0 to 1 (solver/hand.h).
template <class Real>
INLINE Real jetShare(const HandParams<Real>& hand, Vec3<Real> x) {
  const Vec3<Real> direction{hand.directionX, hand.directionY, hand.directionZ};
  const Vec3<Real> d = x - Vec3<Real>{hand.originX, hand.originY, hand.originZ};
  const Real along = dot(d, direction);
  const Vec3<Real> across = d - along * direction;
  const Real inside = Real(1) - hand.inverseRadiusSquared * dot(across, across);
  const Real rise = hand.inverseRadius * along;
  const Real risen = rise < Real(1) ? rise : Real(1);
  const Real share = (inside * inside) * risen;
  const bool reached = (inside > Real(0)) & (rise > Real(0));
  return reached ? canonical(share) : Real(0);
}

// A third of the force of the air on triangle (a, b, c): pressure along its normal, rho C_d / 2 A (u.n)|u.n|
// n, and lift across the relative wind u, rho C_l / 2 A |u|^2 (e.n) (n - (e.n) e) with e = u/|u|. `normal` is
// 2 A n, and the factors of the step hold rho C / 12. Both terms are even in n: it does not matter to which
// side it points.
template <bool jet, class Real>
INLINE Vec3<Real> windForce(const StepParams<Real>& step, const HandParams<Real>& hand, Vec3<Real> a,
                            Vec3<Real> b, Vec3<Real> c, Vec3<Real> va, Vec3<Real> vb, Vec3<Real> vc) {
  constexpr Real third = static_cast<Real>(1.0 / 3.0);
  const Vec3<Real> normal = cross(b - a, c - a);
  const Real normalSquared = dot(normal, normal);
  const Real inverseNormal = inverseSquareRoot(normalSquared);
  Vec3<Real> air{step.airVelocityX, step.airVelocityY, step.airVelocityZ};
  Real share = 0;
  if constexpr (jet) {
    share = jetShare(hand, third * ((a + b) + c));
    const Real jetSpeed = share * hand.jetSpeed;
    air = air + jetSpeed * Vec3<Real>{hand.directionX, hand.directionY, hand.directionZ};
  }
  const Vec3<Real> u = air - third * ((va + vb) + vc);
  const Real speedSquared = dot(u, u);
  const Real inverseSpeed = inverseSquareRoot(speedSquared);
  const Real speed = speedSquared * inverseSpeed;
  const Real through = dot(u, normal);
  const Real across = through * inverseNormal;  // u.n
  const Real acrossMagnitude = across < Real(0) ? -across : across;
  const Real alongNormal = step.dragFactor * (across * acrossMagnitude) + step.liftFactor * (across * speed);
  const Real alongWind = step.liftFactor * ((across * through) * inverseSpeed);
  Vec3<Real> force = alongNormal * normal - alongWind * u;
  if constexpr (jet) {
    const Vec3<Real> part = share * force;
    const bool alone = hand.jetAlone != 0;
    force = {alone ? part.x : force.x, alone ? part.y : force.y, alone ? part.z : force.z};
  }
  const bool degenerate = normalSquared < static_cast<Real>(0x1p-100);
  return {degenerate ? Real(0) : force.x, degenerate ? Real(0) : force.y, degenerate ? Real(0) : force.z};
}

// Rest lengths of a slot: the nominal one for all, or from the table.
template <class Real>
struct NominalLength {
  Real length;
  Real operator[](std::ptrdiff_t) const { return length; }
};

// Whether a cut mask (cloth/cuts.h) says that this spring or triangle is gone; without cuts none is.
template <bool torn>
INLINE bool isGone([[maybe_unused]] const std::uint32_t* cutMasks, [[maybe_unused]] std::ptrdiff_t i,
                   [[maybe_unused]] std::uint32_t bit) {
  if constexpr (torn) return (cutMasks[i] >> bit & 1u) != 0;
  return false;
}

// Which of its incident springs a pass works on, for the particles of a stretch.
struct SpringPlace {
  std::uint32_t bit;     // in incidentSprings
  std::ptrdiff_t other;  // from a particle to the other end
};

// Adds the forces of one incident spring to every particle of the stretch. Of owned springs it returns the
// largest bits of l^2 for the watchdog: one end of each spring is enough.
template <bool owned, bool torn, class Real, class RestLengths>
INLINE auto addSpring(const PassArguments<Real>& arguments, Stretch particles, SpringPlace place,
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
    const bool gone = isGone<torn>(cutMasks, i, bit);
    fx[i] = gone ? fx[i] : fx[i] + f.x;
    fy[i] = gone ? fy[i] : fy[i] + f.y;
    fz[i] = gone ? fz[i] : fz[i] + f.z;
    return gone ? Real(0) : dot(b - a, b - a);
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
[[gnu::noinline, gnu::cold]] void noteOverlong(const PassArguments<Real>& arguments, Stretch particles,
                                               SpringPlace place, Real maxSquared) {
  const Components<Real>& p = arguments.before.positions;
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Vec3<Real> d = load(p.x.data(), p.y.data(), p.z.data(), i + place.other) -
                         load(p.x.data(), p.y.data(), p.z.data(), i);
    const bool gone = arguments.cutMasks != nullptr && isGone<true>(arguments.cutMasks, i, place.bit);
    if (!gone && isBeyond(dot(d, d), maxSquared))
      noteTrouble(arguments.watch, PASS_FORCES, i, REASON_RUNAWAY_STRAIN);
  }
}

template <bool torn, class Real, class RestLengths>
INLINE void addIncidentSpring(const PassArguments<Real>& arguments, Stretch particles, bool owned,
                              SpringPlace place, const SpringParams<Real>& spring, RestLengths rest) {
  if (!owned) {
    addSpring<false, torn>(arguments, particles, place, spring.stiffness, rest);
  } else if (addSpring<true, torn>(arguments, particles, place, spring.stiffness, rest) >
             bitsOf(spring.maxLengthSquared)) {
    noteOverlong(arguments, particles, place, spring.maxLengthSquared);
  }
}

template <bool torn, class Real>
INLINE void addSprings(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  for (std::uint32_t k = 0; k < incidentSprings.size(); ++k) {
    const IncidentSpring& incident = incidentSprings[k];
    const SpringParams<Real>& spring = step.springs[incident.slot];
    const int otherRow = row + incident.rows;
    const bool enabled = (step.enabledSlots >> incident.slot & 1u) != 0;
    if (!enabled || otherRow < 0 || otherRow >= static_cast<int>(step.rows)) continue;
    const Stretch particles = stretch(step, row, incident.columns, incident.columns);
    const SpringPlace place{k, indexOffset(step, incident.columns, incident.rows)};
    if (step.useRestLengthTable != 0) {
      const Real* rest = arguments.restLengths +
                         static_cast<std::size_t>(incident.slot) * step.totalParticles +
                         (incident.owned ? 0 : place.other);
      addIncidentSpring<torn>(arguments, particles, incident.owned, place, spring, rest);
    } else {
      addIncidentSpring<torn>(arguments, particles, incident.owned, place, spring,
                              NominalLength<Real>{spring.restLength});
    }
  }
}

template <bool torn, bool jet, class Real>
INLINE void addWind(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  const Components<Real>&p = arguments.before.positions, &v = arguments.before.velocities;
  const Real *x = p.x.data(), *y = p.y.data(), *z = p.z.data(), *vx = v.x.data(), *vy = v.y.data(),
             *vz = v.z.data();
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  const std::uint32_t* cutMasks = arguments.cutMasks;
  const HandParams<Real>& hand = arguments.hand;
  for (std::uint32_t k = 0; k < incidentTriangles.size(); ++k) {
    const auto& [a, b, c] = incidentTriangles[k];
    const auto [firstRow, lastRow] = std::minmax({a.rows, b.rows, c.rows});
    if (row + firstRow < 0 || row + lastRow >= static_cast<int>(step.rows)) continue;
    const auto [firstColumn, lastColumn] = std::minmax({a.columns, b.columns, c.columns});
    const Stretch particles = stretch(step, row, firstColumn, lastColumn);
    const std::ptrdiff_t ia = indexOffset(step, a.columns, a.rows), ib = indexOffset(step, b.columns, b.rows),
                         ic = indexOffset(step, c.columns, c.rows);
#pragma omp simd
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
      const bool gone = isGone<torn>(cutMasks, i, FIRST_CUT_TRIANGLE + k);
      const Vec3<Real> f =
          windForce<jet>(step, hand, load(x, y, z, i + ia), load(x, y, z, i + ib), load(x, y, z, i + ic),
                         load(vx, vy, vz, i + ia), load(vx, vy, vz, i + ib), load(vx, vy, vz, i + ic));
      fx[i] = gone ? fx[i] : fx[i] + f.x;
      fy[i] = gone ? fy[i] : fy[i] + f.y;
      fz[i] = gone ? fz[i] : fz[i] + f.z;
    }
  }
}

template <class Real>
INLINE void addWind(const PassArguments<Real>& arguments, int row) {
  const bool torn = arguments.cutMasks != nullptr;
  if (torn)
    arguments.jet ? addWind<true, true>(arguments, row) : addWind<true, false>(arguments, row);
  else
    arguments.jet ? addWind<false, true>(arguments, row) : addWind<false, false>(arguments, row);
}

// -a |v| v
template <class Real>
INLINE void addAirResistance(const PassArguments<Real>& arguments, int row) {
  const Components<Real>& v = arguments.before.velocities;
  const Real *vx = v.x.data(), *vy = v.y.data(), *vz = v.z.data();
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  const Real airResistance = arguments.step.airResistance;
  const Stretch particles = stretch(arguments.step, row);
#pragma omp simd
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Vec3<Real> velocity = load(vx, vy, vz, i);
    const Real speedSquared = dot(velocity, velocity);
    const Real speed = speedSquared * inverseSquareRoot(speedSquared);
    const Real scale = airResistance * speed;
    fx[i] = fx[i] - scale * velocity.x;
    fy[i] = fy[i] - scale * velocity.y;
    fz[i] = fz[i] - scale * velocity.z;
  }
}

template <class Real>
INLINE void gatherForcesRow(const PassArguments<Real>& arguments, int row) {
  const Stretch particles = stretch(arguments.step, row);
  std::fill(&arguments.forces.x[0] + particles.begin, &arguments.forces.x[0] + particles.end, Real(0));
  std::fill(&arguments.forces.y[0] + particles.begin, &arguments.forces.y[0] + particles.end, Real(0));
  std::fill(&arguments.forces.z[0] + particles.begin, &arguments.forces.z[0] + particles.end, Real(0));
  arguments.cutMasks != nullptr ? addSprings<true>(arguments, row) : addSprings<false>(arguments, row);
  if (arguments.step.hasWind != 0) addWind(arguments, row);
  if (arguments.step.airResistance > Real(0)) addAirResistance(arguments, row);
}

// One component of x' = x + h v', v' = (1 - damping) v + h (g + w f); pinned particles rest, unless
// movePins() follows.
template <class Real>
INLINE void integrateComponent(const StepParams<Real>& step, Stretch particles, Real gravity,
                               const Real* inverseMass, const Real* force, const Real* position,
                               const Real* velocity, Real* newPosition, Real* newVelocity) {
  const Real timeStep = step.timeStep, velocityKept = step.velocityKept;
#pragma omp simd
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Real acceleration = gravity + inverseMass[i] * force[i];
    const Real v = velocityKept * velocity[i] + timeStep * acceleration;
    const Real x = position[i] + timeStep * v;
    const bool pinned = inverseMass[i] == Real(0);
    newVelocity[i] = pinned ? Real(0) : canonical(v);
    newPosition[i] = pinned ? position[i] : canonical(x);
  }
}

// What a hand does to the particles of the row that it holds, after integrateComponent() (solver/hand.h).
template <class Real>
void pullHeld(const PassArguments<Real>& arguments, int row) {
  const HandParams<Real>& hand = arguments.hand;
  const std::uint32_t blockRow = static_cast<std::uint32_t>(row) - hand.firstRow;
  if (blockRow >= hand.rows) return;
  const Components<Real>& old = arguments.before.positions;
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  for (std::uint32_t k = 0; k < hand.columns; ++k) {
    const std::ptrdiff_t i = stretch(arguments.step, row).begin + hand.firstColumn + k;
    if (arguments.inverseMasses[i] == Real(0)) continue;
    const Hold::Point& point = arguments.held[blockRow * hand.columns + k];
    const Vec3<Real> own{v.x[i], v.y[i], v.z[i]}, x{old.x[i], old.y[i], old.z[i]};
    const Vec3<Real> goal = Vec3<Real>{hand.goalX, hand.goalY, hand.goalZ} + point.offset.cast<Real>();
    const Vec3<Real> towards = goal - x;
    Vec3<Real> pulled =
        (hand.velocityKept * own + hand.pull * towards) + Vec3<Real>{hand.pushX, hand.pushY, hand.pushZ};
    const Real speedSquared = dot(pulled, pulled);
    const Real slower = hand.largestSpeed * inverseSquareRoot(speedSquared);
    if (hand.largestSpeedSquared < speedSquared) pulled = slower * pulled;
    const Vec3<Real> newV = own + static_cast<Real>(point.weight) * (pulled - own);
    const Vec3<Real> newX = x + arguments.step.timeStep * newV;
    p.x[i] = canonical(newX.x);
    p.y[i] = canonical(newX.y);
    p.z[i] = canonical(newX.z);
    v.x[i] = canonical(newV.x);
    v.y[i] = canonical(newV.y);
    v.z[i] = canonical(newV.z);
  }
}

// Where their paths take the pins from their start positions (solver/pin_paths.h), at the velocity that leads
// there.
template <class Real>
void movePins(const PassArguments<Real>& arguments, Stretch particles) {
  const Components<Real>&s = arguments.pinStarts, &old = arguments.before.positions;
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const std::uint32_t number = arguments.pinPathNumbers[i];
    if (number == 0 || arguments.inverseMasses[i] != Real(0)) continue;
    const PinMotionParams<Real>& motion = arguments.pinMotions[number - 1];
    const Vec3<Real> start{s.x[i], s.y[i], s.z[i]};
    const Vec3<Real> d = start - Vec3<Real>{motion.pivotX, motion.pivotY, motion.pivotZ};
    const Vec3<Real> turn{dot({motion.turnXX, motion.turnXY, motion.turnXZ}, d),
                          dot({motion.turnYX, motion.turnYY, motion.turnYZ}, d),
                          dot({motion.turnZX, motion.turnZY, motion.turnZZ}, d)};
    const Vec3<Real> move = turn + Vec3<Real>{motion.shiftX, motion.shiftY, motion.shiftZ};
    const Vec3<Real> sum = start + move;
    p.x[i] = canonical(sum.x);
    p.y[i] = canonical(sum.y);
    p.z[i] = canonical(sum.z);
    const Real inverseTimeStep = arguments.step.inverseTimeStep;
    v.x[i] = canonical(inverseTimeStep * (p.x[i] - old.x[i]));
    v.y[i] = canonical(inverseTimeStep * (p.y[i] - old.y[i]));
    v.z[i] = canonical(inverseTimeStep * (p.z[i] - old.z[i]));
  }
}

template <class Real>
INLINE void integrateRow(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  const Stretch particles = stretch(step, row);
  const auto& [before, after, f] = std::tie(arguments.before, arguments.after, arguments.forces);
  integrateComponent(step, particles, step.gravityX, arguments.inverseMasses, f.x.data(),
                     before.positions.x.data(), before.velocities.x.data(), after.positions.x.data(),
                     after.velocities.x.data());
  integrateComponent(step, particles, step.gravityY, arguments.inverseMasses, f.y.data(),
                     before.positions.y.data(), before.velocities.y.data(), after.positions.y.data(),
                     after.velocities.y.data());
  integrateComponent(step, particles, step.gravityZ, arguments.inverseMasses, f.z.data(),
                     before.positions.z.data(), before.velocities.z.data(), after.positions.z.data(),
                     after.velocities.z.data());
  if (arguments.held != nullptr) pullHeld(arguments, row);
  if (arguments.pinPathNumbers != nullptr) movePins(arguments, particles);
  watchVelocities(arguments, PASS_INTEGRATE, row);
}

template <class Real>
INLINE void kickComponent(const StepParams<Real>& step, Stretch particles, Real gravity,
                          const Real* inverseMass, const Real* force, const Real* velocity,
                          Real* newVelocity) {
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Real acceleration = gravity + inverseMass[i] * force[i];
    const Real v = velocity[i] + step.kickTime * acceleration;
    newVelocity[i] = inverseMass[i] == Real(0) ? velocity[i] : canonical(v);
  }
}

// The spring from `a`, its owner, to `b`: when longer than the limit, both ends move half of the excess
// towards each other, or the free end all of it.
template <class Real>
INLINE void limitSpring(const PassArguments<Real>& arguments, std::ptrdiff_t a, std::ptrdiff_t b,
                        Real limit) {
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  const Vec3<Real> xa{p.x[a], p.y[a], p.z[a]}, xb{p.x[b], p.y[b], p.z[b]};
  const Vec3<Real> d = xb - xa;
  const Real lengthSquared = dot(d, d);
  const Real limitSquared = limit * limit;
  const bool freeA = arguments.inverseMasses[a] > Real(0), freeB = arguments.inverseMasses[b] > Real(0);
  if (!(limitSquared < lengthSquared) || !(freeA || freeB)) return;
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real length = lengthSquared * inverseLength;
  const Real excess = (length - limit) * inverseLength;
  const Real share = freeA && freeB ? Real(0.5) * excess : excess;
  const Vec3<Real> move = share * d;
  const Vec3<Real> kick = arguments.step.inverseTimeStep * move;
  if (freeA) {
    p.x[a] = canonical(xa.x + move.x);
    p.y[a] = canonical(xa.y + move.y);
    p.z[a] = canonical(xa.z + move.z);
    v.x[a] = canonical(v.x[a] + kick.x);
    v.y[a] = canonical(v.y[a] + kick.y);
    v.z[a] = canonical(v.z[a] + kick.z);
  }
  if (freeB) {
    p.x[b] = canonical(xb.x - move.x);
    p.y[b] = canonical(xb.y - move.y);
    p.z[b] = canonical(xb.z - move.z);
    v.x[b] = canonical(v.x[b] - kick.x);
    v.y[b] = canonical(v.y[b] - kick.y);
    v.z[b] = canonical(v.z[b] - kick.z);
  }
}

template <class Real>
void checkStartRow(const PassArguments<Real>& arguments, int row) {
  const Components<Real>&p = arguments.before.positions, &v = arguments.before.velocities;
  const Stretch particles = stretch(arguments.step, row);
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const bool sound = finite(p.x[i]) && finite(p.y[i]) && finite(p.z[i]) && finite(v.x[i]) &&
                       finite(v.y[i]) && finite(v.z[i]) && finite(arguments.inverseMasses[i]);
    if (!sound) noteTrouble(arguments.watch, PASS_START, i, REASON_NON_FINITE);
  }
}

}  // namespace

void checkStart(const PassArguments<float>& arguments, int row) { checkStartRow(arguments, row); }
void checkStart(const PassArguments<double>& arguments, int row) { checkStartRow(arguments, row); }

VECTOR_CLONES void gatherForces(const PassArguments<float>& arguments, int row) {
  gatherForcesRow(arguments, row);
}
void gatherForces(const PassArguments<double>& arguments, int row) { gatherForcesRow(arguments, row); }

VECTOR_CLONES void integrate(const PassArguments<float>& arguments, int row) { integrateRow(arguments, row); }
void integrate(const PassArguments<double>& arguments, int row) { integrateRow(arguments, row); }

template <class Real>
void kick(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  const Stretch particles = stretch(step, row);
  const auto& [before, after, f] = std::tie(arguments.before, arguments.after, arguments.forces);
  kickComponent(step, particles, step.gravityX, arguments.inverseMasses, f.x.data(),
                before.velocities.x.data(), after.velocities.x.data());
  kickComponent(step, particles, step.gravityY, arguments.inverseMasses, f.y.data(),
                before.velocities.y.data(), after.velocities.y.data());
  kickComponent(step, particles, step.gravityZ, arguments.inverseMasses, f.z.data(),
                before.velocities.z.data(), after.velocities.z.data());
  watchVelocities(arguments, PASS_KICK, row);
}

template <class Real>
void limitStrain(const PassArguments<Real>& arguments, const LimitColor& color, std::uint32_t j) {
  const StepParams<Real>& step = arguments.step;
  const SpringOffset& offset = springOffsets[color.slot];
  const std::ptrdiff_t other = indexOffset(step, offset.columns, offset.rows);
  const std::uint32_t row = color.firstRow + color.rowStep * (j / color.rowRun) + j % color.rowRun;
  const std::uint32_t count =
      ownerCount(color.firstColumn, color.columnStep, color.columnRun, color.endColumn);
  const Real* rest = arguments.restLengths + static_cast<std::size_t>(color.slot) * step.totalParticles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t column =
        color.firstColumn + color.columnStep * (i / color.columnRun) + i % color.columnRun;
    const std::ptrdiff_t owner =
        static_cast<std::ptrdiff_t>(step.firstParticle) + row * step.columns + column;
    if (arguments.cutMasks != nullptr && isGone<true>(arguments.cutMasks, owner, color.slot)) continue;
    const Real limit =
        step.useRestLengthTable != 0 ? step.limitFactor * rest[owner] : step.springs[color.slot].limitLength;
    limitSpring(arguments, owner, owner + other, limit);
  }
}

VECTOR_CLONES void watchLimit(const PassArguments<float>& arguments, int row) {
  watchVelocities(arguments, arguments.step.limitPass, row);
}
void watchLimit(const PassArguments<double>& arguments, int row) {
  watchVelocities(arguments, arguments.step.limitPass, row);
}

template void kick(const PassArguments<float>&, int);
template void kick(const PassArguments<double>&, int);
template void limitStrain(const PassArguments<float>&, const LimitColor&, std::uint32_t);
template void limitStrain(const PassArguments<double>&, const LimitColor&, std::uint32_t);

}  // namespace clothsim::cpu
