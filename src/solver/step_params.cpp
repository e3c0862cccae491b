#include "solver/step_params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "cloth/seams.h"
#include "core/hash.h"
#include "scene/forces/air_resistance.h"
#include "shared/forces.h"
#include "shared/implicit.h"
#include "solver/pin_paths.h"
#include "solver/surface.h"

namespace clothsim {
namespace {

// Motion below this part of the spacing counts as little: a step need not be solved to a part of it.
constexpr double LEAST_MOTION = 0.1;

constexpr double PLANE_OFFSET = 0.0001;  // [m], CS184's

Vec3d normalized(Vec3d v) { return (1 / std::sqrt(dot(v, v))) * v; }

template <class Real>
Real real(double x) {
  return static_cast<Real>(x);
}

// The square of a limit, as binary32 can hold it: what is larger is not finite there.
double squareInRange(double limit) {
  return std::min(limit * limit, static_cast<double>(std::numeric_limits<float>::max()));
}

}  // namespace

Vec3d airVelocity(const Wind& wind, double t) {
  if (wind.gust.strength == 0) return wind.velocity;
  // Four sines of equal power at incommensurate multiples of the frequency: variance strength^2.
  constexpr std::array<double, 4> multiples{0.43, 1.0, 1.71, 2.93};
  double gust = 0;
  for (std::size_t i = 0; i < multiples.size(); ++i) {
    const double phase = uniform01(static_cast<std::uint32_t>(wind.gust.seed), static_cast<std::uint32_t>(i));
    gust += std::sin(2 * std::numbers::pi * (multiples[i] * wind.gust.frequency * t + phase));
  }
  gust *= wind.gust.strength * std::sqrt(2.0 / multiples.size());
  const bool calm = wind.velocity == Vec3d{0, 0, 0};
  return wind.velocity + gust * (calm ? Vec3d{1, 0, 0} : normalized(wind.velocity));
}

namespace {

// Whether a collider's surface goes anywhere: a ball that turns in its place does not.
bool travels(const Collider& collider) {
  if (deforms(collider)) return true;
  if (!moves(collider)) return false;
  const std::vector<Motion::Key>& keys =
      std::visit([](const auto& c) -> const std::vector<Motion::Key>& { return c.motion->keys; }, collider);
  return std::any_of(keys.begin(), keys.end(), [&](const Motion::Key& key) {
    return key.position != keys[0].position ||
           (!std::holds_alternative<Sphere>(collider) && key.rotation != keys[0].rotation);
  });
}

}  // namespace

int contactRounds(const Scene& scene) {
  const bool any = std::any_of(scene.colliders.begin(), scene.colliders.end(), travels);
  return any && limitsInPasses(scene) ? 3 : 1;
}

Integrator startingVelocityMeaning(const Scene& scene) {
  for (const ClothSettings& settings : scene.cloths)
    if (settings.ks && scene.solver.integrator == Integrator::verlet) return Integrator::verlet;
  return Integrator::euler;
}

namespace {

// The part of its velocity that a particle keeps over a step of h: CS184's damping is percent a step, a
// material's a rate.
double velocityKept(const ClothSettings& cloth, double h) {
  return cloth.material ? std::exp(-cloth.material->damping * h) : 1 - cloth.damping / 100;
}

// Where steps are long, damping has to be a rate [1/s]: CS184 takes 2700 steps a second.
double dampingRate(const ClothSettings& cloth) {
  return cloth.material ? cloth.material->damping : cloth.damping / 100 * 2700;
}

// The strain limit inside an energy: a spring as stiff as the limit asks for begins half way to it. Within
// the other half, each of the cloth's longest springs carries its weight alone. (Beginning at 4/5 with four
// times that stiffness the defaults' few Newton steps do not find which springs pull: 12 % at 64 x 64 for a
// limit of 10 %, 33 % at 128 x 128.)
constexpr double LIMIT_BEGINS = 0.5;
double limitStiffness(const Piece& piece, double limit) {
  double longest = 0;
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
    if (piece.slotEnabled[slot] || piece.isMesh) longest = std::max(longest, piece.nominalLength[slot]);
  const double weight = 9.81 * piece.particleMass * piece.particleCount();
  return longest > 0 ? std::max(10 * piece.stiffestSpring(), weight / ((1 - LIMIT_BEGINS) * limit * longest))
                     : 0;
}

// By particles, of all pieces.
double meanSpacing(const Cloth& cloth) {
  double sum = 0;
  for (const Piece& piece : cloth.pieces())
    sum += piece.particleCount() * 0.5 * (piece.nominalLength[toLeft] + piece.nominalLength[toUpper]);
  return sum / cloth.particleCount();
}

// What colliders add to CONTACT_OVER_INERTIA: the sheet is to bend around them, not to stretch into them,
// also in long steps. Stiffer contact costs: a coarse vertex that moves as a rigid body cannot follow a
// curved surface, and conjugate gradients have to. With 4 times the stiffest spring, folds of cotton around a
// ball took 5 times the iterations. A limit keeps what slides solvable: where a normal is no axis, a coarse
// matrix has the stiffness of contact and the inertia along the surface in the same entries, and binary32
// holds both up to this ratio.
double contactStiffness(const Piece& piece, double inertia) {
  return std::min(CONTACT_OVER_SPRINGS * piece.stiffestSpring(), piece.particleMass * inertia / LEAST_PIVOT);
}

// What the inertia of all cloths adds to the diagonal of their matrix, together [N/m].
double wholeInertia(const Scene& scene, const Cloth& cloth) {
  const double h = stepLength(scene.solver);
  double sum = 0;
  for (std::size_t i = 0; i < cloth.pieces().size(); ++i) {
    const Piece& piece = cloth.pieces()[i];
    sum += piece.particleCount() * piece.particleMass * (1 + dampingRate(scene.cloths[i]) * h) / (h * h);
  }
  return sum;
}

template <class Real>
void putImplicit(const Scene& scene, const Cloth& cloth, std::size_t pieceIndex, StepParams<Real>& params) {
  if (!isImplicit(scene.solver.integrator)) return;
  const Piece& piece = cloth.pieces()[pieceIndex];
  const double h = stepLength(scene.solver), rate = dampingRate(scene.cloths[pieceIndex]);
  const double inertia = (1 + rate * h) / (h * h);
  params.inertia = real<Real>(inertia);
  params.guessTime = real<Real>(h / (1 + rate * h));
  if (scene.solver.integrator == Integrator::bdf2) {
    const double t = 2 * h / 3;
    params.secondInertia = real<Real>((1 + rate * t) / (t * t));
    params.secondGuessTime = real<Real>(t / (1 + rate * t));
    params.secondTime = real<Real>(t);
    params.secondRate = real<Real>(1 / t);
  }
  params.tolerance = real<Real>(scene.solver.tolerance);
  params.systemTolerance = real<Real>(scene.solver.tolerance * scene.solver.tolerance);
  params.toleratedStiffness =
      real<Real>(scene.solver.tolerance * scene.solver.tolerance * wholeInertia(scene, cloth));
  params.leastMotion = real<Real>(LEAST_MOTION * meanSpacing(cloth));
  params.contactStiffness = real<Real>(contactStiffness(piece, inertia));
  if (!scene.solver.strainLimit) return;
  // A limit of 0 asks for springs that cannot stretch: a tenth of a percent stands for it.
  const double limit = std::max(*scene.solver.strainLimit, 1e-3);
  params.limitStiffness = real<Real>(limitStiffness(piece, limit));
  params.limitFactor = real<Real>(1 + LIMIT_BEGINS * limit);
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
    params.springs[slot].limitLength = real<Real>((1 + LIMIT_BEGINS * limit) * piece.nominalLength[slot]);
}

}  // namespace

bool dependsOnTime(const Scene& scene) {
  if (scene.wind && scene.wind->gust.strength != 0) return true;
  for (const Collider& collider : scene.colliders)
    if (moves(collider)) return true;
  const bool closes =
      std::any_of(scene.seams.begin(), scene.seams.end(), [](const Seam& seam) { return seam.time > 0; });
  return closes || hasPinMotion(scene);
}

std::uint32_t particleForcesOf(const Scene& scene) {
  std::uint32_t forces = 0;
#define ADD_BIT(number, Struct, sources, law) \
  if (Struct::acts(scene)) forces |= 1u << number;
  PARTICLE_FORCES(ADD_BIT)
#undef ADD_BIT
  return forces;
}

namespace {

template <class Real>
void putParticleForces(const Scene& scene, StepParams<Real>& params) {
  params.particleForces = particleForcesOf(scene);
#define PACK(number, Struct, sources, law) Struct::pack(scene, params);
  PARTICLE_FORCES(PACK)
#undef PACK
}

}  // namespace

template <class Real>
StepParams<Real> makeStepParams(const Scene& scene, const Cloth& cloth, std::size_t pieceIndex, double time) {
  const Piece& piece = cloth.pieces()[pieceIndex];
  const double h = stepLength(scene.solver);
  StepParams<Real> params{};
  params.limitPass = scene.solver.selfCollision == SelfCollision::robust ? PASS_EARLY_LIMIT : PASS_LIMIT;
  params.piece = static_cast<std::uint32_t>(pieceIndex);
  params.firstParticle = piece.firstParticle;
  params.columns = static_cast<std::uint32_t>(piece.columns);
  params.rows = static_cast<std::uint32_t>(piece.rows);
  params.totalParticles = cloth.particleCount();
  params.useRestLengthTable = piece.hasRestLengthTable ? 1 : 0;
  params.colliderCount = static_cast<std::uint32_t>(scene.colliders.size());
  params.timeStep = real<Real>(h);
  params.inverseTimeStep = real<Real>(1 / h);
  params.velocityKept = real<Real>(velocityKept(scene.cloths[pieceIndex], h));
  params.hasMaterial = piece.hasMaterial ? 1 : 0;
  params.bendAlongRow = real<Real>(piece.bendAlongRow);
  params.bendAlongColumn = real<Real>(piece.bendAlongColumn);
  putParticleForces(scene, params);
  params.gravityX = real<Real>(scene.gravity.x);
  params.gravityY = real<Real>(scene.gravity.y);
  params.gravityZ = real<Real>(scene.gravity.z);
  params.planeOffset = real<Real>(PLANE_OFFSET);
  params.hasWind = hasAir(scene) ? 1 : 0;
  const double front = piece.rowsGoUp ? -1 : 1;
  params.pressureFactor = real<Real>(front * scene.cloths[pieceIndex].pressure / 6);
  if (scene.wind) {
    const Vec3d velocity = airVelocity(*scene.wind, time);
    params.airVelocityX = real<Real>(velocity.x);
    params.airVelocityY = real<Real>(velocity.y);
    params.airVelocityZ = real<Real>(velocity.z);
    params.dragFactor = real<Real>(scene.wind->airDensity * scene.wind->drag / 12);
    params.liftFactor = real<Real>(scene.wind->airDensity * scene.wind->lift / 12);
  }
  const double limitFactor = 1 + scene.solver.strainLimit.value_or(0);
  params.limitFactor = real<Real>(limitFactor);
  params.maxSpeedSquared = real<Real>(squareInRange(scene.solver.maxSpeed));
  params.isMesh = piece.isMesh ? 1 : 0;
  params.hasSurface = isImplicit(scene.solver.integrator) && hasSurfaceContact(scene) ? 1 : 0;
  params.maxStretch = real<Real>(1 + scene.solver.maxStrain);
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
    const double length = piece.nominalLength[slot];
    params.springs[slot] = {real<Real>(piece.stiffness[slot]), real<Real>(length),
                            real<Real>(limitFactor * length),
                            real<Real>(squareInRange((1 + scene.solver.maxStrain) * length))};
    if (piece.slotEnabled[slot]) params.enabledSlots |= 1u << slot;
  }
  for (std::size_t seam = 0; seam < scene.seams.size(); ++seam)
    params.seams[seam].lengthFactor = real<Real>(seamLengthFactor(scene.seams[seam], time));
  putImplicit(scene, cloth, pieceIndex, params);
  return params;
}

template <class Real>
std::vector<Real> measureRestLengths(const Cloth& cloth) {
  std::vector<Real> lengths;
  if (!cloth.hasRestLengthTable()) return lengths;
  lengths.resize(static_cast<std::size_t>(SPRING_SLOTS) * cloth.particleCount());
  for (const Spring& spring : cloth.springs()) {
    if (spring.number >= lengths.size()) break;  // of meshes
    const Vec3<Real> d = startPosition<Real>(cloth, spring.b) - startPosition<Real>(cloth, spring.a);
    const Real lengthSquared = dot(d, d);
    const std::size_t slot = spring.number % SPRING_SLOTS;
    const auto scale = static_cast<Real>(cloth.pieces()[cloth.pieceOf(spring.a)].restScale);
    lengths[slot * cloth.particleCount() + spring.a] =
        scale * (lengthSquared * inverseSquareRoot(lengthSquared));
  }
  return lengths;
}

std::uint32_t ownerCount(std::uint32_t first, std::uint32_t step, std::uint32_t run, std::uint32_t end) {
  if (first >= end) return 0;
  const std::uint32_t span = end - first;
  return span / step * run + std::min(span % step, run);
}

std::vector<LimitColor> makeLimitColors(const Piece& piece) {
  const auto columns = static_cast<std::uint32_t>(piece.columns),
             rows = static_cast<std::uint32_t>(piece.rows);
  std::vector<LimitColor> colors;
  for (const SpringColor& color : piece.colors) {
    LimitColor result{};
    result.firstColumn = color.first;
    result.endColumn = color.end;
    result.columnStep = result.columnRun = result.rowStep = result.rowRun = result.endRow = 1;
    colors.push_back(result);
  }
  for (std::uint32_t slot = 0; slot < SPRING_SLOTS; ++slot) {
    if (!piece.slotEnabled[slot]) continue;
    const SpringOffset& offset = springOffsets[slot];
    // The direction that is split into two colours: columns for springs along a row, else rows. A spring that
    // spans two cells makes runs of two owners: 2 3 . . 6 7 and 4 5 . . 8 9.
    const bool splitColumns = offset.rows == 0;
    const auto reach = static_cast<std::uint32_t>(std::max(std::abs(offset.columns), std::abs(offset.rows)));
    for (std::uint32_t color = 0; color < 2; ++color) {
      LimitColor result{};
      result.slot = slot;
      result.firstColumn = offset.columns < 0 ? 1 : 0;
      result.columnStep = result.columnRun = result.rowStep = result.rowRun = 1;
      result.endColumn = offset.columns > 0 ? columns - 1 : columns;
      result.endRow = rows;
      const std::uint32_t first = reach * (1 + color);
      (splitColumns ? result.firstColumn : result.firstRow) = first;
      (splitColumns ? result.columnStep : result.rowStep) = 2 * reach;
      (splitColumns ? result.columnRun : result.rowRun) = reach;
      colors.push_back(result);
    }
  }
  return colors;
}

template std::vector<float> measureRestLengths(const Cloth&);
template std::vector<double> measureRestLengths(const Cloth&);
template StepParams<float> makeStepParams(const Scene&, const Cloth&, std::size_t, double);
template StepParams<double> makeStepParams(const Scene&, const Cloth&, std::size_t, double);

}  // namespace clothsim
