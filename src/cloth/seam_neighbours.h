// Which particles do not collide with each other because a seam joins them, or one of them and a neighbour of
// the other: those are nearer in a closed seam than layers of cloth are.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/cloth.h"

namespace clothsim {

struct SeamNeighbours {
  // Of particle i: entries [starts[i], starts[i + 1]), ascending. Empty without seams.
  std::vector<std::uint32_t> starts, entries;

  [[nodiscard]] bool areNear(std::uint32_t i, std::uint32_t j) const;
};

[[nodiscard]] SeamNeighbours seamNeighbours(const Cloth& cloth);

// Of each particle the lowest number among those that seams join to it, directly or by way of others; its own
// where none does.
[[nodiscard]] std::vector<std::uint32_t> seamJoints(const Cloth& cloth);

}  // namespace clothsim
