#include "solver/solver.h"

#include "solver/step_params.h"

namespace clothsim {

State initialState(const Cloth& cloth, const Scene& scene) {
  State state;
  state.positions.resize(cloth.particleCount());
  state.velocities.resize(cloth.particleCount());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const auto x = startPosition<float>(cloth, i);
    state.positions[i] = {x.x, x.y, x.z, static_cast<float>(cloth.inverseMasses()[i])};
  }
  state.integrator = startingVelocityMeaning(scene);
  return state;
}

}  // namespace clothsim
