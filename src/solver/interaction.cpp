#include "solver/interaction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/exact_math.h"

namespace clothsim {
namespace {

// No grab is faster [m/s]. A goal far away is approached at this speed instead of in one step, which would
// tear the particle from its neighbours.
constexpr double LARGEST_GRAB_SPEED = 30;

// No denormals: what a driver makes of them is its own affair.
template <class Real>
Real withoutDenormals(double x) {
  return canonical(static_cast<Real>(x));
}

Vec3d unit(Vec3d v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const Vec3d scaled = (1 / largest) * v;
  return (1 / std::sqrt(dot(scaled, scaled))) * scaled;
}

struct Reach {  // of a block along one direction of the grid
  int first, count;
};
Reach reachOf(int place, int points, double spacing, double radius) {
  const double cells = spacing > 0 ? std::min(radius / spacing, double(points)) : 0;
  const int first = std::max(0, place - static_cast<int>(cells));
  const int last = std::min(points - 1, place + static_cast<int>(cells));
  return {first, last - first + 1};
}

double falloff(double distanceSquared, double radius) {
  if (distanceSquared == 0) return 1;  // the particle itself, whatever the radius
  const double inside = 1 - distanceSquared / (radius * radius);
  return inside > 0 ? inside * inside : 0;
}

GrabSpring::Point grabbedPoint(Vec3d from, Vec3d at, double weight) {
  const Vec3f offset = (at - from).cast<float>();
  return {{canonical(offset.x), canonical(offset.y), canonical(offset.z)}, static_cast<float>(weight)};
}

// Of a mesh, a grid of one row: the block from the first to the last vertex within the radius, as they lie at
// rest.
void grabOfMesh(const Cloth& cloth, std::uint32_t particle, double radius, const ReadPositions& positions,
                GrabSpring& grab) {
  const Piece& mesh = cloth.pieces()[grab.piece];
  const auto weightOf = [&](std::uint32_t i) {
    const Vec3d d = cloth.positions()[i] - cloth.positions()[particle];
    return falloff(dot(d, d), radius);
  };
  std::uint32_t first = particle, last = particle;
  for (std::uint32_t i = mesh.firstParticle; i < mesh.firstParticle + mesh.particleCount(); ++i) {
    if (weightOf(i) == 0) continue;
    first = std::min(first, i);
    last = std::max(last, i);
  }
  grab.firstColumn = first - mesh.firstParticle;
  grab.columns = last - first + 1;
  grab.rows = 1;
  const std::vector<Particle4> now = positions(first, grab.columns);
  const Vec3d origin = vectorOf(now[particle - first]);
  std::vector<GrabSpring::Point> points;
  for (std::uint32_t k = 0; k < grab.columns; ++k)
    points.push_back(grabbedPoint(origin, vectorOf(now[k]), weightOf(first + k)));
  grab.points = std::make_shared<const std::vector<GrabSpring::Point>>(std::move(points));
  grab.from = grab.to = origin;
}

template <class Real>
void putGrabSpring(const GrabSpring& grab, double h, std::uint64_t step, InteractionParams<Real>& params) {
  const double w = std::sqrt(grab.strength);
  const double resistance = 2 * h * w + h * h * grab.strength;
  const double kept = 1 / (1 + resistance);
  const Vec3d goal = placeOf(grab, step + 1);
  const Vec3d velocity = (1 / h) * (goal - placeOf(grab, step));
  const Vec3d push = (kept * 2 * h * w) * velocity;
  params.goalX = withoutDenormals<Real>(goal.x);
  params.goalY = withoutDenormals<Real>(goal.y);
  params.goalZ = withoutDenormals<Real>(goal.z);
  params.velocityKept = withoutDenormals<Real>(kept);
  params.pushX = withoutDenormals<Real>(push.x);
  params.pushY = withoutDenormals<Real>(push.y);
  params.pushZ = withoutDenormals<Real>(push.z);
  params.pull = withoutDenormals<Real>(kept * h * grab.strength);
  params.firstColumn = grab.firstColumn;
  params.firstRow = grab.firstRow;
  params.columns = grab.columns;
  params.rows = grab.rows;
  params.resistance = withoutDenormals<Real>(resistance);
  params.reach = withoutDenormals<Real>(resistance > 0 ? h * (1 + resistance) / resistance : 0);
  params.largestDisplacement = withoutDenormals<Real>(h * LARGEST_GRAB_SPEED);
  params.largestDisplacementSquared = withoutDenormals<Real>(h * h * LARGEST_GRAB_SPEED * LARGEST_GRAB_SPEED);
  params.largestSpeed = withoutDenormals<Real>(LARGEST_GRAB_SPEED);
  params.largestSpeedSquared = withoutDenormals<Real>(LARGEST_GRAB_SPEED * LARGEST_GRAB_SPEED);
}

template <class Real>
void putJet(const Jet& jet, bool alone, InteractionParams<Real>& params) {
  const Vec3d direction = unit(jet.direction);
  params.inverseRadius = withoutDenormals<Real>(1 / jet.radius);
  params.inverseRadiusSquared = withoutDenormals<Real>(1 / (jet.radius * jet.radius));
  params.originX = withoutDenormals<Real>(jet.origin.x);
  params.originY = withoutDenormals<Real>(jet.origin.y);
  params.originZ = withoutDenormals<Real>(jet.origin.z);
  params.jetSpeed = withoutDenormals<Real>(jet.speed);
  params.directionX = withoutDenormals<Real>(direction.x);
  params.directionY = withoutDenormals<Real>(direction.y);
  params.directionZ = withoutDenormals<Real>(direction.z);
  params.jetAlone = alone ? 1 : 0;
}

}  // namespace

GrabSpring makeGrabSpring(const Cloth& cloth, std::uint32_t particle, double strength, double radius,
                          const ReadPositions& positions) {
  GrabSpring grab;
  grab.piece = cloth.pieceOf(particle);
  grab.strength = strength;
  const Piece& piece = cloth.pieces()[grab.piece];
  if (piece.isMesh) {
    grabOfMesh(cloth, particle, radius, positions, grab);
    return grab;
  }
  const int place = static_cast<int>(particle - piece.firstParticle);
  const int column = place % piece.columns, row = place / piece.columns;
  const double dx = piece.nominalLength[toLeft], dy = piece.nominalLength[toUpper];
  const Reach across = reachOf(column, piece.columns, dx, radius),
              along = reachOf(row, piece.rows, dy, radius);
  grab.firstColumn = static_cast<std::uint32_t>(across.first);
  grab.firstRow = static_cast<std::uint32_t>(along.first);
  grab.columns = static_cast<std::uint32_t>(across.count);
  grab.rows = static_cast<std::uint32_t>(along.count);

  std::vector<GrabSpring::Point> points;
  const Vec3d origin = vectorOf(positions(particle, 1)[0]);
  for (int r = along.first; r < along.first + along.count; ++r) {
    const std::vector<Particle4> ofRow = positions(piece.particle(across.first, r), grab.columns);
    for (int c = 0; c < across.count; ++c) {
      const double x = dx * (across.first + c - column), y = dy * (r - row);
      points.push_back(
          grabbedPoint(origin, vectorOf(ofRow[static_cast<std::size_t>(c)]), falloff(x * x + y * y, radius)));
    }
  }
  grab.points = std::make_shared<const std::vector<GrabSpring::Point>>(std::move(points));
  grab.from = grab.to = origin;
  return grab;
}

Vec3d placeOf(const GrabSpring& grab, std::uint64_t steps) {
  if (steps <= grab.firstStep) return grab.from;
  const double part = static_cast<double>(steps - grab.firstStep) / grab.steps;
  return part < 1 ? grab.from + part * (grab.to - grab.from) : grab.to;
}

void moveTo(GrabSpring& grab, Vec3d target, std::uint64_t step, int steps) {
  grab.from = placeOf(grab, step);
  grab.to = target;
  grab.firstStep = step;
  grab.steps = steps;
}

template <class Real>
InteractionParams<Real> makeInteractionParams(const Interaction& interaction, const Scene& scene,
                                              std::uint64_t step) {
  InteractionParams<Real> params{};
  if (interaction.grab) putGrabSpring(*interaction.grab, stepLength(scene.solver), step, params);
  if (interaction.jet) putJet(*interaction.jet, !scene.wind, params);
  return params;
}

template <class Real>
void addJet(const Interaction& interaction, const Scene& scene, shared::StepParams<Real>& params) {
  if (!interaction.jet || scene.wind) return;
  const Wind usual;
  params.hasWind = 1;
  params.dragFactor = static_cast<Real>(usual.airDensity * usual.drag / 12);
  params.liftFactor = static_cast<Real>(usual.airDensity * usual.lift / 12);
}

template InteractionParams<float> makeInteractionParams(const Interaction&, const Scene&, std::uint64_t);
template InteractionParams<double> makeInteractionParams(const Interaction&, const Scene&, std::uint64_t);
template void addJet(const Interaction&, const Scene&, shared::StepParams<float>&);
template void addJet(const Interaction&, const Scene&, shared::StepParams<double>&);

}  // namespace clothsim
