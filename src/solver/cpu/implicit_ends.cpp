// The first and the last pass of an implicit step; the twin of
// shaders/sim/implicit/{begin,end}.comp.
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

}  // namespace

template <class Real>
void begin(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const StepParams<Real>& step = pass.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(step, row);
  const Vec3<Real> gravity{step.gravityX, step.gravityY, step.gravityZ}, zero{};
  if (step.hasWind != 0) gatherWind(pass, row, own.air);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    if (pass.inverseMasses[i] > Real(0)) continue;
    put(pass.after.positions, i, at(pass.before.positions, i));
    put(pass.after.velocities, i, zero);
  }
  movePins(pass, row);
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
    Real stiffness = mass * step.inertia;
    const Vec3<Real> guess = canonical(step.guessTime * (v + step.timeStep * gravity));
    Vec3<Real> b = stiffness * guess;
    forEachParticleForce(
        step, [&](auto law) __attribute__((always_inline)) {
          const ParticleForce<Real> acting = law(x, v, mass);
          b = b + (acting.force + acting.damping * v);
          stiffness = stiffness + (acting.damping * step.inverseTimeStep + acting.stiffness);
        });
    if (step.hasWind != 0) {  // f - R (v' - v)
      const Symmetric<Real> resistance = at(own.air, i);
      b = b + (at(pass.forces, i) + resistance * v);
      put(own.air, i, step.inverseTimeStep * resistance);
    }
    put(own.rightHandSide, i, b);
    own.diagonal[static_cast<std::size_t>(i)] = stiffness;
    const Vec3<Real> start = canonical(step.timeStep * v);
    put(own.displacements, i, start);
    put(own.iterate.positions, i, canonical(x + start));
    if (pass.grabbed != nullptr) grabParticle(arguments, row, i, mass);
  }
}

template <class Real>
void startOnPlanes(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(pass.step, row);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> normal = at(own.planes.normals, i), d = at(own.displacements, i);
    if (pass.inverseMasses[i] == Real(0) || dot(normal, normal) == Real(0)) continue;
    const Vec3<Real> start = canonical(d + (own.planes.offsets.data()[i] - dot(normal, d)) * normal);
    put(own.displacements, i, start);
    put(own.iterate.positions, i, canonical(at(pass.before.positions, i) + start));
  }
}

template <class Real>
void gatherElasticForces(const ImplicitArguments<Real>& arguments, int row) {
  StepParams<Real> elastic = arguments.step.step;  // air is in the right-hand side
  elastic.hasWind = 0;
  elastic.particleForces = 0;
  gatherForces(withState(arguments.step, elastic, arguments.own.iterate, arguments.step.forces), row);
}

template <class Real>
void ImplicitState<Real>::resize(Hierarchy<Real> levels) {
  hierarchy = std::move(levels);
  const std::size_t particles = hierarchy.particles,
                    entries = particles + VERTEX_TEXELS * std::size_t{hierarchy.coarseVertices};
  for (Components<Real>* c :
       {&rightHandSide, &displacements, &iterate.positions, &directions.positions, &products, &increments})
    c->resize(particles);
  diagonal.resize(particles);
  air.resize(particles);
  for (std::vector<Real>& trial : trials) trial.resize(particles);
  for (Components<Real>* c : {&residuals, &corrections}) c->resize(entries);
  factors.resize(particles);
  centers.resize(hierarchy.coarseVertices);
  coarseBlocks.resize(hierarchy.blocks.size());
  elementSums.resize(hierarchy.blocks.size());
  coarseInverses.resize(hierarchy.coarseVertices);
  dense.resize(hierarchy.denseEntries);
}

namespace {

// What the solution leaves of Coulomb's friction stops the slip, or shortens it: nothing creeps that sticks.
template <class Real>
INLINE Vec3<Real> withFriction(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i,
                               Vec3<Real> displacement) {
  const ContactPlanes<Real>& planes = arguments.own.planes;
  const Vec3<Real> slip = slipOf(planes, i, displacement);
  const Real squared = dot(slip, slip), inverse = inverseSquareRoot(squared), length = squared * inverse;
  const Real used = frictionSlope(length, inverse, slowSlip(arguments.step.step)).over * length;
  const Real rest = planes.limits.data()[i] * (Real(1) - used);
  const Real lost = (larger(rest, Real(0)) * reciprocal(arguments.own.diagonal.data()[i])) * inverse;
  return displacement - (lost < Real(1) ? lost : Real(1)) * slip;
}

}  // namespace

template <class Real>
void end(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const Range all = rangeOf(pass.step, row);
  const bool contacts = hasContacts(arguments);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const bool pinned = pass.inverseMasses[i] == Real(0);
    if (pinned) continue;  // begin() has moved pins
    Vec3<Real> displacement = at(arguments.own.displacements, i);
    if (contacts) displacement = canonical(withFriction(arguments, i, displacement));
    put(pass.after.positions, i, canonical(at(pass.before.positions, i) + displacement));
    put(pass.after.velocities, i, canonical(pass.step.inverseTimeStep * displacement));
  }
  watchVelocities(pass, PASS_INTEGRATE, row);
}

template void begin(const ImplicitArguments<float>&, int);
template void begin(const ImplicitArguments<double>&, int);
template void gatherElasticForces(const ImplicitArguments<float>&, int);
template void gatherElasticForces(const ImplicitArguments<double>&, int);
template struct ImplicitState<float>;
template struct ImplicitState<double>;
template void startOnPlanes(const ImplicitArguments<float>&, int);
template void startOnPlanes(const ImplicitArguments<double>&, int);
template void end(const ImplicitArguments<float>&, int);
template void end(const ImplicitArguments<double>&, int);

}  // namespace clothsim::cpu
