#include "measure/measure_contacts.h"

#include <algorithm>
#include <cmath>

#include "cloth/cuts.h"
#include "solver/cpu/self_collision.h"

namespace clothsim {
namespace {

constexpr double CONTACT_REACH =
    1.05;  // a resolved contact leaves a pair at the contact distance or slightly more

// The distance at rest of two particles of one piece, unless they share a cell and a spring. Infinite for
// particles of two pieces.
std::optional<double> restDistance(const Cloth& cloth, const Piece& piece, const Cuts& cuts,
                                   const std::vector<std::uint32_t>& cutMasks, std::uint32_t i,
                                   std::uint32_t j) {
  if (j - piece.firstParticle >= piece.particleCount()) return INFINITY;
  if (piece.isMesh) {
    if (areJoined(cuts, cloth, i, j)) return std::nullopt;
    const Vec3d d = cloth.positions()[i] - cloth.positions()[j];
    return std::sqrt(dot(d, d));
  }
  const auto columns = static_cast<std::int64_t>(piece.columns);
  const std::int64_t a = i - piece.firstParticle, b = j - piece.firstParticle;
  const std::int64_t right = b % columns - a % columns, down = b / columns - a / columns;
  const std::int64_t across = std::abs(right), along = std::abs(down);
  if (across <= 1 && along <= 1) {
    const std::uint32_t spring = springWithinCell(static_cast<int>(right), static_cast<int>(down));
    if (cutMasks.empty() || (cutMasks[i] >> spring & 1u) == 0) return std::nullopt;
  }
  return std::hypot(static_cast<double>(across) * piece.nominalLength[toLeft],
                    static_cast<double>(along) * piece.nominalLength[toUpper]);
}

}  // namespace

ContactMeasures measureContacts(const Cloth& cloth, const Scene& scene, const State& state, double strain) {
  ContactMeasures measures;
  if (!collidesWithItself(scene, cloth)) return measures;
  const double d = contactDistance(scene, cloth), h = stepLength(scene.solver);
  measures.neededDistance = crossingDistance(cloth, std::max(strain, 0.0));

  Components<float> positions;
  positions.resize(state.positions.size());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    positions.x[i] = state.positions[i].x;
    positions.y[i] = state.positions[i].y;
    positions.z[i] = state.positions[i].z;
  }
  cpu::SelfCollision<float> search(cloth);
  search.configure(scene);
  const std::vector<std::uint32_t> cutMasks = makeCutMasks(cloth, state.cuts);
  search.setCuts(state.cuts);
  for (const auto& [i, j] : search.candidatePairs(positions)) {
    if (j < i) continue;
    const std::optional<double> rest =
        restDistance(cloth, cloth.pieces()[cloth.pieceOf(i)], state.cuts, cutMasks, i, j);
    if (!rest) continue;
    const Vec3d apart = vectorOf(state.positions[i]) - vectorOf(state.positions[j]);
    const Vec3d relative = vectorOf(state.velocities[i]) - vectorOf(state.velocities[j]);
    const double distance = std::sqrt(dot(apart, apart));
    measures.contacts += distance < CONTACT_REACH * std::min(d, *rest);
    // A pair that lies nearer at rest than D needs the same share of its own distance.
    measures.overlaps += distance < measures.neededDistance * std::min(1.0, *rest / d);
    measures.smallestDistance = std::min(measures.smallestDistance.value_or(distance), distance);
    measures.relativeMotion = std::max(measures.relativeMotion, h * std::sqrt(dot(relative, relative)));
  }
  return measures;
}

}  // namespace clothsim
