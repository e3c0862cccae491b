// What stays of a simulation when an edit of the scene makes a new cloth.
#pragma once

#include <vector>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "session/actions.h"
#include "solver/state.h"

namespace clothsim {

// Whether the solvers cannot take the edit live (Solver::configure()).
[[nodiscard]] bool needsRebuild(const Scene& before, const Scene& after);
// Grids of the same sizes that start at the same places.
[[nodiscard]] bool haveSameLattice(const Cloth& a, const Cloth& b);
// The state for a new cloth on the same lattice: particles stay pinned or free as they are, unless the pins
// of the scene differ there; their masses are the new ones.
[[nodiscard]] State carriedOver(const State& state, const Cloth& before, const Cloth& after);
// Pins set by hand, at the nearest points of a cloth on another lattice.
[[nodiscard]] std::vector<SetPin> pinsByHand(const State& state, const Cloth& before, const Cloth& after);

}  // namespace clothsim
