// Whether cloth that nothing drives has more energy than falling has given it: explicit contact may push
// layers apart harder than they came together.
#pragma once

#include <optional>
#include <vector>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "solver/state.h"

namespace clothsim {

class EnergyWatch {
 public:
  // `start`: the cloth at rest, without strain. Where pins, colliders, air, attractors, seams or shrinking
  // drive the cloth, nothing is watched.
  EnergyWatch(const Cloth& cloth, const Scene& scene, const State& start);
  // To be called at the end of every frame, with the kinetic energy [J].
  void add(int frame, const Cloth& cloth, const State& state, double kinetic);

  struct Gain {
    int frame = 0;                   // the first with a gain
    double kinetic = 0, fallen = 0;  // at most, and what falling had given until then [J]
  };
  [[nodiscard]] const std::optional<Gain>& gain() const { return gain_; }

 private:
  [[nodiscard]] double heightEnergy(const Cloth& cloth, const State& state) const;

  bool isWatched_;
  Vec3d gravity_;  // [m/s^2]
  double start_ = 0, least_ = 0;
  std::optional<Gain> gain_;
};

}  // namespace clothsim
