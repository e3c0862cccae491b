// The first and the last pass of an implicit step; the twin of
// shaders/sim/implicit/{begin,initial_guess,end}.comp.
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
    put(own.displacements, i, zero);
    put(own.iterate.positions, i, x);
    if (pass.grabbed != nullptr) grabParticle(arguments, row, i, mass);
  }
}

// What of its fall was not held up in the step before (solver/implicit.h).
template <class Real>
void initialGuess(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const StepParams<Real>& step = pass.step;
  const Range all = rangeOf(step, row);
  const Vec3<Real> gravity{step.gravityX, step.gravityY, step.gravityZ};
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Real falls = 1 - pass.support[i];
    const Vec3<Real> fall =
        step.guessTime * (at(pass.before.velocities, i) + (falls * step.timeStep) * gravity);
    const bool pinned = pass.inverseMasses[i] == Real(0);
    put(arguments.own.increments, i, selected(pinned, Vec3<Real>{}, canonical(fall)));
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
void ImplicitState<Real>::resize(std::size_t particles, std::size_t vertices) {
  for (Components<Real>* c :
       {&rightHandSide, &displacements, &iterate.positions, &directions.positions, &products, &increments})
    c->resize(particles);
  diagonal.resize(particles);
  air.resize(particles);
  for (std::vector<Real>& trial : trials) trial.resize(particles);
  for (Components<Real>* c : {&residuals, &corrections}) c->resize(vertices);
  for (SymmetricField<Real>* field : {&stiffness, &inertia, &factors}) field->resize(vertices);
}

namespace {

// How far the collider that a particle touches pushed it out in the step [m].
template <class Real>
INLINE Real pushedOut(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i, Vec3<Real> displacement) {
  const Real push = contactPush(arguments, i, displacement);
  const PassArguments<Real>& pass = arguments.step;
  const Real inertia = reciprocal(pass.inverseMasses[i]) * pass.step.inertia;
  return push > Real(0) ? push * reciprocal(inertia) : Real(0);
}
// Coulomb: the way along the surface, shorter by the coefficient times that depth.
template <class Real>
INLINE Vec3<Real> withFriction(const ContactPlanes<Real>& planes, std::ptrdiff_t i, Real depth,
                               Vec3<Real> displacement) {
  const Vec3<Real> normal = at(planes.normals, i), carry = at(planes.carries, i);
  const Vec3<Real> relative = displacement - carry;
  const Vec3<Real> across = dot(relative, normal) * normal;
  const Vec3<Real> slide = relative - across;
  const Real lost = (planes.frictions.data()[i] * depth) * inverseSquareRoot(dot(slide, slide));
  const Real kept = lost < Real(1) ? Real(1) - lost : Real(0);
  return (carry + across) + kept * slide;
}

// How much of its weight something held up, 0 to 1 (solver/implicit.h).
template <class Real>
INLINE Real supportOf(const StepParams<Real>& step, Vec3<Real> before, Vec3<Real> displacement) {
  const Vec3<Real> fallen = (step.inertia * step.timeStep) * displacement - before;
  const Real support =
      1 - dot(fallen, Vec3<Real>{step.gravityX, step.gravityY, step.gravityZ}) * step.supportScale;
  const Real atLeast = Real(0) < support ? support : Real(0);
  return atLeast < Real(1) ? atLeast : Real(1);
}

}  // namespace

template <class Real>
void end(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const Range all = rangeOf(pass.step, row);
  const bool contacts = hasContacts(arguments);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const bool pinned = pass.inverseMasses[i] == Real(0);
    pass.support[i] = 0;
    if (pinned) continue;  // begin() has moved pins
    const Vec3<Real> v = at(pass.before.velocities, i);
    Vec3<Real> displacement = at(arguments.own.displacements, i),
               place = at(arguments.own.iterate.positions, i), unpushed = displacement;
    if (contacts) {
      const Vec3<Real> normal = at(arguments.own.planes.normals, i);
      const Real depth = pushedOut(arguments, i, displacement);
      unpushed = displacement - depth * normal;
      if (depth > Real(0)) {
        displacement = canonical(withFriction(arguments.own.planes, i, depth, displacement));
        place = canonical(at(pass.before.positions, i) + displacement);
      }
    }
    pass.support[i] = supportOf(pass.step, v, unpushed);
    put(pass.after.positions, i, place);
    put(pass.after.velocities, i, canonical(pass.step.inverseTimeStep * displacement));
  }
  watchVelocities(pass, PASS_INTEGRATE, row);
}

template void begin(const ImplicitArguments<float>&, int);
template void begin(const ImplicitArguments<double>&, int);
template void initialGuess(const ImplicitArguments<float>&, int);
template void initialGuess(const ImplicitArguments<double>&, int);
template void gatherElasticForces(const ImplicitArguments<float>&, int);
template void gatherElasticForces(const ImplicitArguments<double>&, int);
template struct ImplicitState<float>;
template struct ImplicitState<double>;
template void end(const ImplicitArguments<float>&, int);
template void end(const ImplicitArguments<double>&, int);

}  // namespace clothsim::cpu
