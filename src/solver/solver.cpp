#include "solver/solver.h"

#include "core/exact_math.h"
#include "core/hash.h"
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

void jitter(State& state, double distance, std::uint32_t seed) {
  std::uint32_t drawn = 0;
  const auto moved = [&](float x) {
    return canonical(x + static_cast<float>(distance * uniform01(seed, drawn++)));
  };
  for (Particle4& x : state.positions)
    if (x.w > 0) x = {moved(x.x), moved(x.y), moved(x.z), x.w};
}

}  // namespace clothsim
