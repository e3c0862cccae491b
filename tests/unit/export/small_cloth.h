// A horizontal sheet of 3 x 2 points and a state whose numbers do not fit short decimals.
#pragma once

#include "cloth/cloth.h"
#include "solver/state.h"

namespace clothsim::test {

inline Scene smallScene() {
  Scene scene;
  scene.cloths[0].numWidthPoints = 3;
  scene.cloths[0].numHeightPoints = 2;
  scene.cloths[0].width = 2;
  scene.cloths[0].height = 1;
  scene.cloths[0].ks = 5000;
  scene.cloths[0].pinned = {GridPoint{0, 0}};
  return scene;
}

// As the cloth lies, each particle with its own velocity.
inline State smallState(const Cloth& cloth) {
  State state;
  state.clock = {12345678901, 0.25, 7.5, 3};
  state.integrator = Integrator::euler;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3f x = cloth.positions()[i].cast<float>();
    state.positions.push_back({x.x, x.y, x.z, static_cast<float>(cloth.inverseMasses()[i])});
    state.velocities.push_back({1.0f / 3.0f, static_cast<float>(i), 1e-30f, 0});
  }
  return state;
}

}  // namespace clothsim::test
