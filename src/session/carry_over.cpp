#include "session/carry_over.h"

#include <algorithm>
#include <cmath>

#include "cloth/pins.h"

namespace clothsim {

namespace {

bool haveSameHolds(const ClothSettings& a, const ClothSettings& b) {
  const auto lets = [](const PinMotion& motion) { return motion.release || !freeKeys(motion).empty(); };
  if (std::ranges::none_of(a.pinMotion, lets) && std::ranges::none_of(b.pinMotion, lets)) return true;
  return std::ranges::equal(a.pinMotion, b.pinMotion, [](const PinMotion& x, const PinMotion& y) {
    return freeKeys(x) == freeKeys(y) && x.release == y.release && x.pinned == y.pinned;
  });
}

}  // namespace

bool needsRebuild(const Scene& before, const Scene& after) {
  if (before.cloths.size() != after.cloths.size() || before.seams != after.seams) return true;
  for (std::size_t i = 0; i < before.cloths.size(); ++i) {
    ClothSettings cloth = before.cloths[i];
    cloth.damping = after.cloths[i].damping;
    cloth.render = after.cloths[i].render;
    if (haveSameHolds(cloth, after.cloths[i])) cloth.pinMotion = after.cloths[i].pinMotion;
    if (cloth != after.cloths[i]) return true;
  }
  return false;
}

bool haveSameLattice(const Cloth& a, const Cloth& b) {
  return std::ranges::equal(
             a.pieces(), b.pieces(),
             [](const Piece& x, const Piece& y) { return x.columns == y.columns && x.rows == y.rows; }) &&
         std::ranges::equal(a.positions(), b.positions()) && a.lists().triangles == b.lists().triangles;
}

State carriedOver(const State& state, const Cloth& before, const Cloth& after) {
  State result = state;
  forgetHistory(result);
  for (const Piece& piece : after.pieces()) {
    for (std::uint32_t i = piece.firstParticle; i < piece.firstParticle + piece.particleCount(); ++i) {
      const bool wasPinned = before.inverseMasses()[i] == 0, isPinned = after.inverseMasses()[i] == 0;
      const bool pinned = wasPinned == isPinned ? state.positions[i].w == 0 : isPinned;
      if (isPinned && !wasPinned) std::erase(result.offPath, i);  // the scene has it now
      result.positions[i].w = pinned ? 0 : static_cast<float>(1 / after.massOf(i));
      if (pinned && state.positions[i].w != 0) result.velocities[i] = {};
    }
  }
  return result;
}

std::vector<SetPin> pinsByHand(const State& state, const Cloth& before, const Cloth& after) {
  std::vector<SetPin> pins;
  for (const std::uint32_t particle : state.offPath) {
    const std::size_t index = before.pieceOf(particle);
    if (index >= after.pieces().size()) continue;
    const Piece &from = before.pieces()[index], &to = after.pieces()[index];
    if (from.isMesh || to.isMesh) continue;  // a vertex of a mesh has no place on another cloth
    const int place = static_cast<int>(particle - from.firstParticle);
    const auto nearest = [](int point, int points, int newPoints) {
      const double part = points > 1 ? double(point) / (points - 1) : 0;
      return static_cast<int>(std::lround(part * (newPoints - 1)));
    };
    pins.push_back({to.particle(nearest(place % from.columns, from.columns, to.columns),
                                nearest(place / from.columns, from.rows, to.rows)),
                    state.positions[particle].w == 0});
  }
  return pins;
}

}  // namespace clothsim
