// Cloth that tears: after each frame, springs that are too long are cut, with the triangles beside them.
#pragma once

#include <span>

#include "cloth/cuts.h"
#include "scene/scene.h"
#include "solver/state.h"

namespace clothsim {

// Whether some cloth has a tear_strain.
[[nodiscard]] bool canTear(const Scene& scene);

// Whether something is cut, or can be after the next frame.
[[nodiscard]] inline bool mayBeCut(const Scene& scene, const Cuts& cuts) {
  return !cuts.empty() || canTear(scene);
}

// Looks at the structural springs of cloths that have a tear_strain. One that is longer tears when no
// spring that shares an end with it is stretched more: so a tear runs on from where it ends, and cloth that
// is stretched evenly does not fall to crumbs. A grid tears from the middle of one cell beside it to the
// middle of the other; a mesh loses the triangles beside the edge. In double precision from the positions in
// binary32: the same on both backends. Returns whether anything tore.
bool tear(Cuts& cuts, const Cloth& cloth, const Scene& scene, std::span<const Particle4> positions);

}  // namespace clothsim
