// Whether the surface has gone through itself before the first step: contact inside the step keeps parts on
// the sides on which they are (solver/surface.h), also on the wrong ones.
#pragma once

#include <cstdint>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "solver/state.h"

namespace clothsim {

// How many pairs of a side and a triangle that have no particle in common, and no seam, cross, by signs of
// volumes in double: what only touches does not count. CrossingCounter (crossings.h) is exact, and needs
// CGAL.
[[nodiscard]] std::uint64_t crossingSides(const Cloth& cloth, const Scene& scene, const State& state);

}  // namespace clothsim
