// What is kept of a state when an edit of the scene makes a new cloth.
#pragma once

#include <vector>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "session/actions.h"
#include "solver/state.h"

namespace clothsim {

// Whether the edit needs a new cloth; Solver::configure() takes all other edits.
[[nodiscard]] bool needsRebuild(const Scene& before, const Scene& after);
// Whether the grids have the same sizes and their points start at the same places.
[[nodiscard]] bool haveSameLattice(const Cloth& a, const Cloth& b);
// The state for a new cloth on the same lattice. A particle stays pinned or free unless the pins of the scene
// have changed there; then a path may move it that the user had taken it off. Masses are those of the new
// cloth, whose next step looks back at none.
[[nodiscard]] State carriedOver(const State& state, const Cloth& before, const Cloth& after);
// The pins that the user has set, at the nearest points of a cloth on another lattice.
[[nodiscard]] std::vector<SetPin> pinsByHand(const State& state, const Cloth& before, const Cloth& after);
// The scene with the pins that the user has set, and without those that he has taken off; where a cloth has
// pins on paths, which name them, all of its own stay.
[[nodiscard]] Scene withPinsByHand(Scene scene, const Cloth& cloth, const State& state);

}  // namespace clothsim
