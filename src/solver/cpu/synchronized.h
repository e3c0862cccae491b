// Velocities of a state's own time, for energies.
#pragma once

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "solver/state.h"

namespace clothsim {

// The same state with velocities of its own time: under `verlet` 1/2 (v(n-1/2) + v(n+1/2)), which energies
// are made of.
[[nodiscard]] State synchronized(const Cloth& cloth, const Scene& scene, const State& state);

}  // namespace clothsim
