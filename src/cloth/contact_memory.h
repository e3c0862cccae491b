// What CS184's self-collision may take of a machine, found out before it is taken.
#pragma once

#include "scene/budget.h"
#include "scene/scene.h"

namespace clothsim {

// Its rule keeps every pair of particles within 2 thickness, hundreds for each where the lattice is fine.
// @throws SceneError when particles and pairs together need more than `memory` [bytes]
void checkContactMemory(const Scene& scene, double memory = machineMemory());

}  // namespace clothsim
