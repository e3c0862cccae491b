// What the normals pass of a mesh looks at around each particle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth/cloth.h"

namespace clothsim {

// One array of words, for mesh_normals.comp. First for each particle of the mesh, and once behind the last,
// where its corners begin: of every triangle around it the two other corners in their order, as particles,
// and 0, or where in textureCoordinatesOf() three texture coordinates begin that hold in this triangle
// instead, of the particle and of these two.
// Behind those for each particle MESH_RING particles about `reach` [m] away over the mesh, spread around it;
// near a border the particle itself stands for those that are not there. `lists`: remainingLists().
[[nodiscard]] std::vector<std::uint32_t> meshNeighbours(const Cloth& cloth, const SpringLists& lists,
                                                        const Piece& mesh, double reach);

// Those of all particles, and behind them those of the corners at seams of the texture.
[[nodiscard]] std::vector<std::array<float, 2>> textureCoordinatesOf(const Cloth& cloth);

}  // namespace clothsim
