#include "solver/pass.h"

#include <array>

namespace clothsim {
namespace {

using enum Array;
using F = Feature;

constexpr Features elastic{F::springs, F::restLengths, F::meshes, F::cuts, F::seams};
constexpr Features air{F::wind, F::particleForces, F::jets, F::externalForces, F::meshes, F::cuts};
constexpr Features solved = elastic | Features{F::wind, F::planes, F::surface,
                                               F::smallColliders};  // what the linear system is made of

// A table; clang-format would put each field on a line of its own.
// clang-format off
constexpr std::array<PassTraits, PASS_COUNT> table{{
    // pass, name, runs over, reach,
    //   gathers, reads,
    //   writes, features
    {Pass::checkStart, "start", Domain::gridPoints, 0,
     {}, {positions, velocities},
     {watch}, {}},
    {Pass::kick, "kick", Domain::gridPoints, 0,
     {}, {positions, velocities, forces},
     {newVelocities, watch}, {}},
    {Pass::forces, "forces", Domain::gridPoints, 2,
     {positions, velocities}, {},
     {forces, watch}, elastic | air},
    {Pass::integrate, "integrate", Domain::gridPoints, 0,
     {}, {positions, velocities, forces},
     {newPositions, newVelocities, watch}, {F::movingPins, F::grabs}},
    {Pass::predictPlanes, "predict planes", Domain::gridPoints, 0,
     {}, {positions, velocities, elasticSlips},
     {planes, contactBlocks, scalars}, {F::colliders, F::planes, F::history}},
    {Pass::begin, "begin", Domain::gridPoints, 1,
     {positions, velocities, scalars}, {planes, histories},
     {newPositions, newVelocities, forces, rightHandSides, airBlocks, displacements, iterates},
     air | Features{F::movingPins, F::grabs, F::planes, F::history}},
    {Pass::findPlanes, "contact planes", Domain::gridPoints, 0,
     {}, {positions, iterates, elasticSlips},
     {planes}, {F::colliders}, Gate::step},
    {Pass::elasticForces, "elastic forces", Domain::gridPoints, 2,
     {iterates}, {},
     {forces, watch}, elastic, Gate::step},
    {Pass::linearize, "linearize", Domain::gridPoints, 2,
     {iterates, pairForces}, {forces, rightHandSides, airBlocks, planes, contactBlocks, displacements, touching, scalars},
     {residuals, factors, increments, contactBlocks}, solved, Gate::step},
    {Pass::findCenters, "find centers", Domain::coarseVertices, 1,
     {iterates, centers}, {},
     {centers}, {}},
    {Pass::coarsen, "coarsen", Domain::coarseBlocks, 1,
     {positions, iterates, centers, coarseBlocks}, {rightHandSides, airBlocks, planes, touching, scalars},
     {coarseBlocks, coarseInverses}, solved},
    {Pass::invertDense, "invert dense", Domain::coarseBlocks, 1,
     {centers, coarseBlocks}, {},
     {dense}, {}},
    {Pass::restrict, "restrict", Domain::coarseVertices, 1,
     {iterates, residuals}, {},
     {residuals}, {}, Gate::system},
    {Pass::solveCoarsest, "solve coarsest", Domain::coarseVertices, 1,
     {iterates, centers, residuals}, {dense},
     {corrections}, {}, Gate::system},
    {Pass::prolong, "prolong", Domain::fineVertices, 1,
     {iterates, centers, corrections}, {residuals, factors, coarseInverses},
     {corrections}, {}, Gate::system},
    {Pass::sumFirstResidual, "sum r.z", Domain::sums, 0,
     {}, {residuals, corrections},
     {partialSums, scalars}, {}, Gate::step},
    {Pass::updateDirection, "update direction", Domain::particles, 0,
     {}, {iterates, corrections, directions, scalars},
     {directions}, {}, Gate::system},
    {Pass::multiply, "multiply", Domain::gridPoints, 2,
     {iterates, directions, pairForces}, {rightHandSides, airBlocks, contactBlocks, touching},
     {products}, solved, Gate::system},
    {Pass::sumCurvature, "sum p.Hp", Domain::sums, 0,
     {}, {directions, products},
     {partialSums, scalars}, {}, Gate::system},
    {Pass::updateSolution, "update solution", Domain::particles, 0,
     {}, {directions, products, increments, residuals, scalars},
     {increments, residuals}, {}, Gate::system},
    {Pass::sumNextResidual, "sum r.z", Domain::sums, 0,
     {}, {residuals, corrections},
     {partialSums, scalars}, {}, Gate::system},
    {Pass::stopAtPlanes, "stop at planes", Domain::particles, 0,
     {}, {iterates, increments, displacements, planes, contactBlocks},
     {increments}, {F::planes}, Gate::step},
    {Pass::tryLengths, "try lengths", Domain::gridPoints, 2,
     {iterates, increments, displacements}, {rightHandSides, airBlocks, planes, contactBlocks, touching},
     {products}, solved, Gate::step},
    {Pass::sumEnergies, "sum energies", Domain::sums, 0,
     {}, {products},
     {partialSums, scalars}, {}, Gate::step},
    {Pass::accept, "accept", Domain::particles, 0,
     {}, {positions, increments, displacements, scalars},
     {displacements, iterates}, {}, Gate::step},
    {Pass::measureUpdate, "measure update", Domain::sums, 0,
     {}, {increments, displacements},
     {partialSums, scalars}, {}, Gate::step},
    {Pass::end, "end", Domain::gridPoints, 0,
     {}, {positions, rightHandSides, displacements, planes, contactBlocks, elasticSlips, histories, scalars},
     {newPositions, newVelocities, newElasticSlips, watch}, {F::movingPins, F::planes, F::history}},
    {Pass::remember, "remember", Domain::gridPoints, 0,
     {}, {positions, velocities, newPositions, newVelocities, displacements},
     {histories, scalars}, {}},
    {Pass::countStep, "count step", Domain::sums, 0,
     {}, {},
     {scalars}, {}},
    {Pass::findTouching, "find touching", Domain::surface, 0,
     {positions, safePositions, displacements, iterates}, {rightHandSides, pairSlips},
     {touching, scalars}, {F::cuts, F::smallColliders}},
    {Pass::weighPairs, "weigh pairs", Domain::surface, 0,
     {positions, displacements}, {rightHandSides, touching, scalars},
     {touching, pairForces, scalars}, {F::colliders, F::smallColliders}, Gate::step},
    {Pass::multiplyPairs, "multiply pairs", Domain::surface, 0,
     {directions}, {touching},
     {pairForces}, {}, Gate::system},
    {Pass::keepSlips, "keep slips", Domain::surface, 0,
     {displacements}, {touching, scalars},
     {newPairSlips}, {}},
    {Pass::guard, "guard", Domain::surface, 0,
     {positions, safePositions, newPositions, keptMotions}, {newVelocities},
     {keptMotions, newPositions, newVelocities}, {F::cuts}},
    {Pass::shorten, "shorten", Domain::surface, 0,
     {}, {positions, safePositions, newPositions, newVelocities, keptMotions},
     {newPositions, newVelocities}, {}},
    {Pass::settle, "settle", Domain::surface, 0,
     {}, {positions, newPositions, newVelocities, keptMotions},
     {safePositions, displacements, iterates, scalars}, {}},
    {Pass::pressOut, "press out", Domain::surface, 0,
     {positions, newPositions}, {newVelocities, touching},
     {newPositions, newVelocities, touching, pairForces}, {F::colliders, F::smallColliders}},
    {Pass::checkHash, "check hash", Domain::contacts, 0,
     {}, {positions, newPositions, hash},
     {contactFlags}, {}},
    {Pass::buildHash, "build hash", Domain::contacts, 0,
     {positions, newPositions}, {contactFlags, watch},
     {hash, contactFlags}, {}},
    {Pass::findCandidates, "find candidates", Domain::contacts, 0,
     {hash}, {contactFlags},
     {candidates}, {F::meshes, F::cuts, F::seams}},
    {Pass::resolveContacts, "resolve contacts", Domain::contacts, 0,
     {positions, newPositions, hash, candidates}, {contactFlags},
     {newPositions, newVelocities}, {F::meshes, F::cuts, F::seams}},
    {Pass::checkMotion, "check motion", Domain::contacts, 0,
     {positions, newPositions, hash, candidates}, {},
     {contactFlags}, {F::meshes, F::cuts, F::seams}},
    {Pass::clampMotion, "clamp motion", Domain::contacts, 0,
     {positions, newPositions, hash, candidates}, {contactFlags},
     {newPositions, newVelocities}, {F::meshes, F::cuts, F::seams}},
    {Pass::collide, "collide", Domain::gridPoints, 0,
     {}, {positions, newPositions, newVelocities},
     {newPositions, newVelocities, watch}, {F::colliders}},
    {Pass::limit, "limit", Domain::springs, 2,
     {newPositions, newVelocities}, {},
     {newPositions, newVelocities}, {F::springs, F::restLengths, F::meshes, F::cuts}},
    {Pass::watchLimit, "watch limit", Domain::gridPoints, 0,
     {}, {newVelocities},
     {watch}, {}},
}};
// clang-format on

constexpr bool isInOrder() {
  for (std::size_t i = 0; i < table.size(); ++i)
    if (static_cast<std::size_t>(table[i].pass) != i) return false;
  return true;
}
static_assert(isInOrder(), "the table has the order of the enumerators");

constexpr std::array<std::string_view, ARRAY_COUNT> arrayNames{
    "positions",      "velocities",       "new positions",
    "new velocities", "forces",           "planes",
    "contact blocks", "elastic slips",    "new elastic slips",
    "histories",      "right-hand sides", "air blocks",
    "displacements",  "iterates",         "residuals",
    "corrections",    "factors",          "centers",
    "coarse blocks",  "coarse inverses",  "dense",
    "directions",     "products",         "increments",
    "partial sums",   "scalars",          "hash",
    "candidates",     "touching",         "pair slips",
    "new pair slips", "pair forces",      "kept motions",
    "safe positions", "contact flags",    "watch"};

constexpr std::array<std::string_view, FEATURE_COUNT> featureNames{
    "springs",         "rest lengths", "meshes",      "wind",      "particle forces", "jets",    "grabs",
    "external forces", "cuts",         "moving pins", "colliders", "planes",          "history", "surface",
    "small colliders", "seams"};

bool runsByRows(Domain domain) { return domain == Domain::gridPoints || domain == Domain::particles; }

}  // namespace

std::string_view nameOf(Array array) { return arrayNames[static_cast<std::size_t>(array)]; }
std::string_view nameOf(Feature feature) { return featureNames[static_cast<std::size_t>(feature)]; }

std::string_view nameOf(Domain domain) {
  switch (domain) {
    case Domain::gridPoints:
      return "grid points";
    case Domain::particles:
      return "particles";
    case Domain::springs:
      return "springs of a colour";
    case Domain::coarseVertices:
      return "coarse vertices";
    case Domain::coarseBlocks:
      return "coarse blocks";
    case Domain::fineVertices:
      return "fine vertices";
    case Domain::sums:
      return "a sum of all";
    case Domain::contacts:
      return "particles in cells";
    case Domain::surface:
      return "parts of the surface";
  }
  return "";
}

const PassTraits& traitsOf(Pass pass) { return table[static_cast<std::size_t>(pass)]; }

bool canShareSweep(const PassTraits& earlier, const PassTraits& later) {
  return earlier.gate == later.gate && runsByRows(earlier.domain) && runsByRows(later.domain) &&
         !later.gathers.overlaps(earlier.writes) && !earlier.gathers.overlaps(later.writes);
}

}  // namespace clothsim
