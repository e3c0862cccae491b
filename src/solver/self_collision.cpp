#include "solver/self_collision.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "cloth/material.h"
#include "core/exact_math.h"
#include "solver/step_params.h"

namespace clothsim {
namespace {

constexpr double MARGIN_AVERAGED = 0.4, MARGIN_ROBUST = 0.5;  // in d
constexpr double LARGEST_MOVE = 0.06;                         // of robust self-collision in a step, in d
constexpr double RELATIVE_MOTION = 0.3;                       // delta, in spacings
// Covers the rounding of positions to cells, which are clamped to +-2^17: 2^-7 of a cell at most for each of
// two particles.
constexpr double CELL_MARGIN = 1.02;
constexpr double ROUNDING = 1e-3;  // kept clear of every bound

constexpr double CROSSING_OF_LONGEST_EDGE = 0.764;  // self_collision.h

double spacing(const Piece& piece) {
  if (piece.isMesh) return CROSSING_OF_LONGEST_EDGE * piece.longestEdge;
  const double x = piece.nominalLength[toLeft], y = piece.nominalLength[toUpper];
  return std::sqrt((x * x + y * y) / 2);
}

// A rope has none across.
double smallestSpacing(const Piece& grid) {
  const double x = grid.nominalLength[toLeft], y = grid.nominalLength[toUpper];
  return x == 0 ? y : y == 0 ? x : std::min(x, y);
}

double largestSpacing(const Cloth& cloth) {
  double largest = 0;
  for (const Piece& piece : cloth.pieces()) largest = std::max(largest, spacing(piece));
  return largest;
}

std::size_t firstCode(const Scene& scene) {
  return scene.solver.selfCollision == SelfCollision::robust ? 2 : 1;
}

// Coulomb's coefficient between layers: the scene's own, or the roughest material's.
double layerFriction(const Scene& scene) {
  if (scene.solver.selfFriction) return *scene.solver.selfFriction;
  constexpr double usual = 0.3;
  double friction = usesMaterial(scene) ? 0 : usual;
  for (const ClothSettings& settings : scene.cloths)
    if (settings.material) friction = std::max(friction, settings.material->friction);
  return friction;
}

}  // namespace

bool collidesWithItself(const Scene& scene, const Cloth& cloth) {
  const SelfCollision mode = scene.solver.selfCollision;
  return (mode == SelfCollision::averaged || mode == SelfCollision::robust) &&
         contactDistance(scene, cloth) > 0;
}

double expectedStrain(const Scene& scene) { return scene.solver.strainLimit.value_or(0.25); }

double crossingDistance(const Cloth& cloth, double stretch) { return (1 + stretch) * largestSpacing(cloth); }

double thicknessDistance(const Scene& scene) {
  double thickness = 0;
  for (const ClothSettings& settings : scene.cloths)
    thickness = std::max(thickness, settings.thicknessInUse());
  return scene.solver.selfCollision == SelfCollision::robust ? thickness : 2 * thickness;
}

double contactDistance(const Scene& scene, const Cloth& cloth) {
  double finest = largestSpacing(cloth), distance = thicknessDistance(scene);
  const bool onlyMeshes = std::all_of(cloth.pieces().begin(), cloth.pieces().end(),
                                      [](const Piece& piece) { return piece.isMesh; });
  for (const Piece& piece : cloth.pieces())
    if (!piece.isMesh) finest = std::min(finest, smallestSpacing(piece));
  if (scene.solver.selfCollision == SelfCollision::robust)
    distance = std::max(distance, crossingDistance(cloth, expectedStrain(scene)) +
                                      RELATIVE_MOTION / 2 * largestSpacing(cloth));
  return onlyMeshes ? distance : std::min(distance, 7 * finest);
}

template <class Real>
SelfParams<Real> makeSelfParams(const Scene& scene, const Cloth& cloth) {
  const auto real = [](double x) { return static_cast<Real>(x); };
  const bool robust = scene.solver.selfCollision == SelfCollision::robust;
  const double d = contactDistance(scene, cloth);
  const double margin = (robust ? MARGIN_ROBUST : MARGIN_AVERAGED) * d;
  const double move = robust ? LARGEST_MOVE * d : 0;
  const double reuse = (margin / 2 - move) * (1 - ROUNDING);
  const double search = (d + margin) * (1 + ROUNDING);
  const double units = std::ldexp(1.0, FIXED_POINT_BITS<Real>) / d;

  SelfParams<Real> params{};
  params.particles = cloth.particleCount();
  params.bucketMask = std::bit_ceil(std::max(params.particles, 64u)) - 1;
  params.bucketBlocks = params.bucketMask / BUCKETS_A_BLOCK + 1;
  params.firstCode = static_cast<std::uint32_t>(firstCode(scene));
  params.inverseCell = real(1 / (search * CELL_MARGIN));
  params.searchSquared = real(search * search);
  params.reuseSquared = real(reuse * reuse);
  params.inverseTimeStep = real(1 / stepLength(scene.solver));
  params.distance = real(d);
  params.unitsPerMeter = real(units);
  params.moveFactor = real((robust ? 1 : 1.0 / scene.solver.simulationSteps) / units);
  params.largestMove = real(LARGEST_MOVE * d);
  params.friction = real(robust ? layerFriction(scene) : 0);
  const double crossing = std::min(crossingDistance(cloth, expectedStrain(scene)), d);
  params.clampFactor = real(crossing / d);
  const double fast = (d + margin - crossing) / 2;
  params.fastSquared = real(fast * fast);
  params.codesPerMeter = real(NEAREST_CODES / d);
  return params;
}

template <class Real>
std::vector<Real> makeContactDistances(const Scene& scene, const Cloth& cloth) {
  const double d = contactDistance(scene, cloth);
  std::vector<Real> distances;
  for (const Piece& piece : cloth.pieces()) {
    for (std::size_t code = 0; code < NEAREST_CODES; ++code) {
      const std::size_t across = code % 8, along = code / 8;
      const double x = static_cast<double>(across) * piece.nominalLength[toLeft],
                   y = static_cast<double>(along) * piece.nominalLength[toUpper];
      const double rest =
          piece.isMesh ? d * static_cast<double>(code) / NEAREST_CODES : std::sqrt(x * x + y * y);
      distances.push_back(static_cast<Real>(code == 0 ? d : std::min(d, rest)));
    }
  }
  return distances;
}

bool hasNearCodes(const Scene& scene, const Cloth& cloth) {
  const double d = contactDistance(scene, cloth);
  const auto first = static_cast<double>(firstCode(scene));
  if (cloth.hasMesh()) return true;
  return std::any_of(cloth.pieces().begin(), cloth.pieces().end(),
                     [&](const Piece& piece) { return first * smallestSpacing(piece) < d; });
}

template SelfParams<float> makeSelfParams(const Scene&, const Cloth&);
template SelfParams<double> makeSelfParams(const Scene&, const Cloth&);
template std::vector<float> makeContactDistances(const Scene&, const Cloth&);
template std::vector<double> makeContactDistances(const Scene&, const Cloth&);

}  // namespace clothsim
