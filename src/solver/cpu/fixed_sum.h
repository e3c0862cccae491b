// Sums over all particles in an order that depends on nothing but their number (shared/implicit.h); the twin
// of shaders/sim/implicit/total.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/thread_team.h"
#include "shared/implicit.h"

namespace clothsim::cpu {

// How many blocks a thread takes at once.
inline constexpr std::uint32_t BLOCKS_AT_ONCE = 4;

template <class Real>
Real addLanes(std::array<Real, SUM_LANES>& lanes) {
  for (std::size_t stride = SUM_LANES / 2; stride > 0; stride /= 2)
    for (std::size_t lane = 0; lane < stride; ++lane) lanes[lane] = lanes[lane] + lanes[lane + stride];
  return lanes[0];
}

// valueAt(0) + ... + valueAt(count - 1). `partials` is scratch.
template <class Real, class ValueAt>
Real fixedSum(std::size_t count, std::vector<Real>& partials, ValueAt valueAt) {
  const std::size_t blocks = (count + SUM_BLOCK - 1) / SUM_BLOCK;
  partials.resize(blocks);
  ThreadTeam::shared().forEach(
      0, static_cast<std::uint32_t>(blocks), BLOCKS_AT_ONCE, [&](std::uint32_t block) {
        std::array<Real, SUM_LANES> lanes{};
        for (std::size_t first = std::size_t{block} * SUM_BLOCK;
             first < std::min(count, (std::size_t{block} + 1) * SUM_BLOCK); first += SUM_LANES) {
          const std::size_t lanesHere = std::min<std::size_t>(SUM_LANES, count - first);
          for (std::size_t lane = 0; lane < lanesHere; ++lane)
            lanes[lane] = lanes[lane] + valueAt(first + lane);
        }
        partials[block] = addLanes(lanes);
      });
  std::array<Real, SUM_LANES> lanes{};
  for (std::size_t block = 0; block < blocks; ++block)
    lanes[block % SUM_LANES] = lanes[block % SUM_LANES] + partials[block];
  return addLanes(lanes);
}

}  // namespace clothsim::cpu
