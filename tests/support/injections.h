// Infinities and NaNs put at random (but always the same) places of a state, and scenes that explode.
#pragma once

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "solver/state.h"
#include "support/test_scenes.h"

namespace clothsim::test {

struct Injection {
  int step = 0;  // after which it happens
  std::uint32_t particle = 0;
  int component = 0;  // x, y, z, vx, vy, vz
  float value = 0;

  [[nodiscard]] State into(State state) const {
    Particle4& target = component < 3 ? state.positions[particle] : state.velocities[particle];
    (component % 3 == 0 ? target.x : component % 3 == 1 ? target.y : target.z) = value;
    return state;
  }
  [[nodiscard]] std::string text() const {
    return std::to_string(value) + " in component " + std::to_string(component) + " of particle " +
           std::to_string(particle) + " after step " + std::to_string(step);
  }
};

inline std::vector<Injection> makeInjections(const Cloth& cloth, int count) {
  std::mt19937 random(184);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const float values[] = {nan, -nan, nan, inf, -inf};
  std::vector<Injection> injections;
  for (int i = 0; i < count; ++i) {
    Injection injection;
    injection.step = static_cast<int>(below(30));
    injection.particle = below(cloth.particleCount());
    injection.component = static_cast<int>(below(6));
    injection.value = values[below(5)];
    injections.push_back(injection);
  }
  return injections;
}

// Springs far too stiff for one step a frame.
inline Scene exploding(Scene scene) {
  for (ClothSettings& cloth : scene.cloths) {
    if (cloth.stiffnessReference)
      cloth.stiffnessReference = 1e7;
    else
      cloth.ks = 1e7;
  }
  scene.solver.simulationSteps = 1;
  return scene;
}

}  // namespace clothsim::test
