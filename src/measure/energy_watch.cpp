#include "measure/energy_watch.h"

#include <algorithm>

#include "scene/colliders/collider.h"

namespace clothsim {
namespace {

// Of what falling has given, that counts as a gain: what springs still hold is little.
constexpr double DOUBTFUL_PART = 1.5;
// The same for cloth that hardly falls: what it gives to fall by so many of the smallest spacings.
constexpr double DOUBTFUL_SPACINGS = 0.5;

bool isDriven(const Scene& scene) {
  return hasAir(scene) || !scene.attractors.empty() || !scene.seams.empty() ||
         std::ranges::any_of(scene.colliders, [](const Collider& collider) { return moves(collider); }) ||
         std::ranges::any_of(scene.cloths, [](const ClothSettings& cloth) {
           return !cloth.pinMotion.empty() || cloth.shrink != 0;
         });
}

}  // namespace

EnergyWatch::EnergyWatch(const Cloth& cloth, const Scene& scene, const State& start)
    : isWatched_(!isDriven(scene)), gravity_(scene.gravity) {
  if (!isWatched_) return;
  start_ = heightEnergy(cloth, start);
  double mass = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) mass += cloth.massOf(i);
  least_ = DOUBTFUL_SPACINGS * smallestSpacing(cloth) * length(gravity_) * mass;
}

double EnergyWatch::heightEnergy(const Cloth& cloth, const State& state) const {
  double sum = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Particle4& x = state.positions[i];
    sum -= cloth.massOf(i) * dot(gravity_, Vec3f{x.x, x.y, x.z}.cast<double>());
  }
  return sum;
}

void EnergyWatch::add(int frame, const Cloth& cloth, const State& state, double kinetic) {
  if (!isWatched_) return;
  const double fallen = start_ - heightEnergy(cloth, state);
  if (kinetic <= DOUBTFUL_PART * fallen + least_) return;
  if (!gain_) gain_ = Gain{frame, 0, 0};
  if (kinetic > gain_->kinetic) {
    gain_->kinetic = kinetic;
    gain_->fallen = std::max(fallen, 0.0);
  }
}

}  // namespace clothsim
