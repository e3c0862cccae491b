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
  if (before.cloths.size() != after.cloths.size() || before.seams.size() != after.seams.size()) return true;
  for (std::size_t i = 0; i < before.seams.size(); ++i) {
    Seam seam = before.seams[i];
    seam.time = after.seams[i].time;
    if (seam != after.seams[i]) return true;
  }
  for (std::size_t i = 0; i < before.cloths.size(); ++i) {
    ClothSettings cloth = before.cloths[i];
    cloth.damping = after.cloths[i].damping;
    cloth.pressure = after.cloths[i].pressure;
    cloth.tearStrain = after.cloths[i].tearStrain;
    cloth.render = after.cloths[i].render;
    if (cloth.material && after.cloths[i].material) {
      cloth.material->damping = after.cloths[i].material->damping;
      cloth.material->friction = after.cloths[i].material->friction;
    }
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

Scene withPinsByHand(Scene scene, const Cloth& cloth, const State& state) {
  const auto pinOf = [&](const Piece& piece, std::uint32_t particle) -> Pin {
    const auto place = static_cast<int>(particle - piece.firstParticle);
    if (piece.isMesh)
      return vertexPinOf(scene.cloths[cloth.pieceOf(particle)], particle - piece.firstParticle);
    return GridPoint{place % piece.columns, place / piece.columns};
  };
  const auto isFree = [&](std::uint32_t particle) { return state.positions[particle].w != 0; };
  const auto isScenes = [&](std::uint32_t particle) { return cloth.inverseMasses()[particle] == 0; };
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    ClothSettings& settings = scene.cloths[i];
    const Piece& piece = cloth.pieces()[i];
    const auto isOwn = [&](std::uint32_t particle) { return cloth.pieceOf(particle) == i; };
    const bool takesOff =
        settings.pinMotion.empty() && std::ranges::any_of(state.offPath, [&](std::uint32_t particle) {
          return isOwn(particle) && isScenes(particle) && isFree(particle);
        });
    if (takesOff) {  // sides and regions become the points that are left of them
      settings.pinned.clear();
      for (std::uint32_t k = piece.firstParticle; k < piece.firstParticle + piece.particleCount(); ++k)
        if (isScenes(k) && !(isFree(k) && std::ranges::binary_search(state.offPath, k)))
          settings.pinned.push_back(pinOf(piece, k));
    }
    for (const std::uint32_t particle : state.offPath)
      if (isOwn(particle) && !isScenes(particle) && !isFree(particle))
        settings.pinned.push_back(pinOf(piece, particle));
  }
  return scene;
}

}  // namespace clothsim
