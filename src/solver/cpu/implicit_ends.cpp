// The first and the last pass of an implicit step; the twin of
// shaders/sim/implicit/{begin,end}.comp.
#include <atomic>

#include "solver/cpu/implicit_contact.h"
#include "solver/cpu/particle_forces.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {
namespace {

// What a grab adds to a particle's diagonal and right-hand side (solver/interaction.h).
template <class Real>
void grabParticle(const ImplicitArguments<Real>& arguments, int row, std::ptrdiff_t i, Real mass) {
  const PassArguments<Real>& pass = arguments.step;
  const InteractionParams<Real>& interaction = pass.interaction;
  const bool isMesh = pass.step.isMesh != 0;  // whose block is a part of its one row
  const std::uint32_t column = static_cast<std::uint32_t>(
      i - (isMesh ? static_cast<std::ptrdiff_t>(pass.step.firstParticle) : rangeOf(pass.step, row).begin));
  const std::uint32_t blockRow = isMesh ? 0 : static_cast<std::uint32_t>(row) - interaction.firstRow,
                      blockColumn = column - interaction.firstColumn;
  if (blockRow >= interaction.rows || blockColumn >= interaction.columns) return;
  const GrabSpring::Point& point = pass.grabbed[blockRow * interaction.columns + blockColumn];
  const Vec3<Real> goal =
      Vec3<Real>{interaction.goalX, interaction.goalY, interaction.goalZ} + point.offset.cast<Real>();
  const Vec3<Real> towards = goal - at(pass.before.positions, i);
  Vec3<Real> displacement =
      interaction.reach *
      (interaction.pull * towards + Vec3<Real>{interaction.pushX, interaction.pushY, interaction.pushZ});
  const Real displacementSquared = dot(displacement, displacement);
  const Real shorter = interaction.largestDisplacement * inverseSquareRoot(displacementSquared);
  if (interaction.largestDisplacementSquared < displacementSquared) displacement = shorter * displacement;
  const Real inverseTimeStep = pass.step.inverseTimeStep;
  const Real stiffness = (static_cast<Real>(point.weight) * interaction.resistance) *
                         ((mass * inverseTimeStep) * inverseTimeStep);
  arguments.own.diagonal[static_cast<std::size_t>(i)] += stiffness;
  put(arguments.own.rightHandSide, i, at(arguments.own.rightHandSide, i) + stiffness * displacement);
}

// How the velocity at the end comes from the displacement d: rate (d - carried). Backward Euler, or of second
// order from the step before (solver/implicit.h).
template <class Real>
struct TimeScheme {
  bool isSecondOrder;
  Real rate, inertia, guessTime, gravityTime;
};
template <class Real>
TimeScheme<Real> timeSchemeOf(const ImplicitArguments<Real>& arguments) {
  const StepParams<Real>& step = arguments.step.step;
  const ImplicitScalars<Real>& scalars = arguments.own.scalars;
  if (step.secondRate > Real(0) && scalars.usualSteps >= USUAL_STEPS && scalars.hasNewContacts == 0)
    return {true, step.secondRate, step.secondInertia, step.secondGuessTime, step.secondTime};
  return {false, step.inverseTimeStep, step.inertia, step.guessTime, step.timeStep};
}

template <class Real>
Vec3<Real> startOf(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i) {
  return canonical(arguments.step.step.timeStep * at(arguments.step.before.velocities, i));
}

}  // namespace

template <class Real>
void predictPlanes(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const StepParams<Real>& step = pass.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(step, row);
  const Vec3<Real> gravity{step.gravityX, step.gravityY, step.gravityZ};
  Components<Real>& places = own.planes.newElasticSlips;  // scratch here: the end of the step writes it
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    put(own.planes.normals, i, Vec3<Real>{});
    put(places, i,
        at(pass.before.positions, i) +
            step.guessTime * (at(pass.before.velocities, i) + step.timeStep * gravity));
  }
  findPlanes(pass, places, own.planes, row);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i)
    put(places, i, canonical(at(pass.before.positions, i) + startOf(arguments, i)));
  findPlanes(pass, places, own.planes, row);
  const auto isNewWhere = [&](bool wasHeld) {
    bool isNew = false;
    for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
      const Vec3<Real> normal = at(own.planes.normals, i);
      const bool hasPlane = dot(normal, normal) > Real(0), held = own.planes.heldLimits.data()[i] > Real(0);
      isNew = isNew || (held == wasHeld && hasPlane != held);
    }
    return isNew;
  };
  const bool isSecondOrder = step.secondRate > Real(0), touchesMore = isSecondOrder && isNewWhere(false);
  // What is so near that a solved step may be wrong about it may be held or not, and is not new either way.
  findPlanes(pass, places, own.planes, row, step.tolerance * step.leastMotion);
  if (touchesMore || (isSecondOrder && isNewWhere(true)))
    std::atomic_ref(own.scalars.hasNewContacts).store(1, std::memory_order_relaxed);
}

// Pins at the end of the step, where their paths lead.
template <class Real>
void placePins(const PassArguments<Real>& pass, int row) {
  const Range all = rangeOf(pass.step, row);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    if (pass.inverseMasses[i] > Real(0)) continue;
    put(pass.after.positions, i, at(pass.before.positions, i));
    put(pass.after.velocities, i, Vec3<Real>{});
  }
  movePins(pass, row);
}

template <class Real>
void begin(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const StepParams<Real>& step = pass.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(step, row);
  const Vec3<Real> gravity{step.gravityX, step.gravityY, step.gravityZ}, zero{};
  const TimeScheme<Real> scheme = timeSchemeOf(arguments);
  const bool contacts = hasContacts(arguments);
  if (step.hasWind != 0) gatherWind(pass, row, own.air);
  placePins(pass, row);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> x = at(pass.before.positions, i), v = at(pass.before.velocities, i);
    if (pass.inverseMasses[i] == Real(0)) {
      const Vec3<Real> target = at(pass.after.positions, i);
      put(own.rightHandSide, i, zero);
      own.diagonal[static_cast<std::size_t>(i)] = 0;
      put(own.displacements, i, target - x);
      put(own.iterate.positions, i, target);
      continue;
    }
    const Real mass = reciprocal(pass.inverseMasses[i]);
    Vec3<Real> moving = v, carried{};
    if (scheme.isSecondOrder) {
      moving = v + at(own.acceleratedBefore, i);
      carried = at(own.movedBefore, i);
    }
    Real stiffness = mass * scheme.inertia;
    Vec3<Real> guess = scheme.guessTime * (moving + scheme.gravityTime * gravity);
    if (scheme.isSecondOrder) guess = guess + carried;
    Vec3<Real> b = stiffness * canonical(guess);
    forEachParticleForce(
        step, [&](auto law) __attribute__((always_inline)) {
          const ParticleForce<Real> acting = law(x, v, mass);
          const Real damping = acting.damping * scheme.rate;
          b = b + (acting.force + acting.damping * v);
          if (scheme.isSecondOrder) b = b + damping * carried;
          stiffness = stiffness + (damping + acting.stiffness);
        });
    if (pass.externalForces != nullptr) {
      const Particle4& force = pass.externalForces[i];
      b = b + Vec3f{force.x, force.y, force.z}.cast<Real>();
    }
    if (step.hasWind != 0) {  // f - R (v' - v)
      const Symmetric<Real> resistance = at(own.air, i), damping = scheme.rate * resistance;
      b = b + (at(pass.forces, i) + resistance * v);
      if (scheme.isSecondOrder) b = b + damping * carried;
      put(own.air, i, damping);
    }
    put(own.rightHandSide, i, b);
    own.diagonal[static_cast<std::size_t>(i)] = stiffness;
    Vec3<Real> start = startOf(arguments, i);
    // Cloth that lies on cloth does not start on the floor below: a plane lifts, and does not pull.
    const auto isBelow = [&] {
      return own.planes.offsets.data()[i] - dot(at(own.planes.normals, i), start) > Real(0);
    };
    if (contacts && (step.hasSurface == 0 || isBelow())) start = canonical(onPlane(own.planes, i, start));
    put(own.displacements, i, start);
    put(own.iterate.positions, i, canonical(x + start));
    if (pass.grabbed != nullptr) grabParticle(arguments, row, i, mass);
  }
}

template <class Real>
void gatherElasticForces(const ImplicitArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  StepParams<Real> elastic = arguments.step.step;  // all else is in the right-hand side
  elastic.hasWind = 0;
  elastic.particleForces = 0;
  PassArguments<Real> pass = withState(arguments.step, elastic, arguments.own.iterate, arguments.step.forces);
  pass.externalForces = nullptr;
  gatherForces(pass, row, rows);
}

template <class Real>
void ImplicitState<Real>::resize(Hierarchy<Real> levels, std::size_t meshMembranes) {
  hierarchy = std::move(levels);
  toParticles = prolongationBySixteen(hierarchy);
  levelRanges = levelRangesOf(hierarchy);
  membranes.resize(meshMembranes);
  const std::size_t particles = hierarchy.particles;
  for (Components<Real>* c : {&rightHandSide, &displacements, &iterate.positions, &residuals, &corrections,
                              &directions.positions, &products, &increments})
    c->resize(particles);
  diagonal.resize(particles);
  air.resize(particles);
  for (std::vector<Real>& trial : trials) trial.resize(particles);
  elements.resize(particles);
  factors.resize(particles);
  centers.resize(hierarchy.coarseVertices);
  forces.resize(particles + hierarchy.coarseVertices);
  coarseCorrections.resize(hierarchy.coarseVertices);
  coarseBlocks.resize(hierarchy.blocks.size());
  elementSums.resize(hierarchy.blocks.size());
  coarseInverses.resize(hierarchy.coarseVertices);
  dense.resize(hierarchy.denseEntries);
}

namespace {

// How the slip of a step ends: `elastic` of it, and of what was before, friction remembers and begins with in
// the next step; `taken` is taken back. So what sticks stays where it is.
template <class Real>
struct SlipEnd {
  Vec3<Real> elastic{}, taken{};
};
template <class Real>
INLINE SlipEnd<Real> slipEnd(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i) {
  const ContactPlanes<Real>& planes = arguments.own.planes;
  const Real limit = planes.limits.data()[i], slow = slowSlip(arguments.step.step);
  const Vec3<Real> slip = slipOf(planes, i, at(arguments.own.displacements, i)),
                   own = slip - tangential(at(planes.normals, i), at(planes.elasticSlips, i));
  const Real squared = dot(slip, slip), inverse = inverseSquareRoot(squared), length = squared * inverse;
  const Real used = frictionSlope(length, inverse, slow).over * length, part = slow * inverse;
  // What the solution leaves of Coulomb's friction stops the slip, or shortens it.
  const Real rest = larger(limit * (Real(1) - used), Real(0)) * reciprocal(arguments.own.diagonal.data()[i]),
             lost = rest * inverseSquareRoot(dot(own, own));
  if (!(limit > Real(0))) return {};
  return {(part < Real(1) ? part : Real(1)) * slip, (lost < Real(1) ? lost : Real(1)) * own};
}

}  // namespace

template <class Real>
void end(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const Range all = rangeOf(pass.step, row);
  const bool contacts = hasContacts(arguments);
  const TimeScheme<Real> scheme = timeSchemeOf(arguments);
  placePins(pass, row);  // again: in a further round of contact, those that were kept back try to go on
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const SlipEnd<Real> slip = contacts ? slipEnd(arguments, i) : SlipEnd<Real>{};
    if (contacts) {
      ContactPlanes<Real>& planes = arguments.own.planes;
      const Vec3<Real> block = at(planes.blocks, i).diagonal;
      put(planes.newElasticSlips, i, canonical(slip.elastic));
      planes.newHeldLimits.data()[i] =
          heldLimit((block.x + block.y) + block.z > Real(0), planes.limits.data()[i]);
    }
    if (pass.inverseMasses[i] == Real(0)) continue;
    Vec3<Real> displacement = canonical(at(arguments.own.displacements, i) - slip.taken);
    put(pass.after.positions, i, canonical(at(pass.before.positions, i) + displacement));
    if (scheme.isSecondOrder) displacement = displacement - at(arguments.own.movedBefore, i);
    put(pass.after.velocities, i, canonical(scheme.rate * displacement));
  }
  watchVelocities(pass, PASS_INTEGRATE, row);
}

// The history of a step that something else has a part in, as contact between particles, does not count.
template <class Real>
void remember(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(pass.step, row);
  const Real third = static_cast<Real>(1.0 / 3), most = pass.step.tolerance * pass.step.leastMotion;
  bool isDisturbed = false;
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> moved = at(pass.after.positions, i) - at(pass.before.positions, i),
                     accelerated = at(pass.after.velocities, i) - at(pass.before.velocities, i),
                     aside = moved - at(own.displacements, i);
    put(own.movedBefore, i, canonical(third * moved));
    put(own.acceleratedBefore, i, canonical(third * accelerated));
    isDisturbed = isDisturbed || dot(aside, aside) > most * most;
  }
  if (isDisturbed) std::atomic_ref(own.scalars.isDisturbed).store(1, std::memory_order_relaxed);
}

template void begin(const ImplicitArguments<float>&, int);
template void begin(const ImplicitArguments<double>&, int);
template void gatherElasticForces(const ImplicitArguments<float>&, int, ForceRows<float>&);
template void gatherElasticForces(const ImplicitArguments<double>&, int, ForceRows<double>&);
template struct ImplicitState<float>;
template struct ImplicitState<double>;
template void predictPlanes(const ImplicitArguments<float>&, int);
template void predictPlanes(const ImplicitArguments<double>&, int);
template void remember(const ImplicitArguments<float>&, int);
template void remember(const ImplicitArguments<double>&, int);
template void end(const ImplicitArguments<float>&, int);
template void end(const ImplicitArguments<double>&, int);

}  // namespace clothsim::cpu
