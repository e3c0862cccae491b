#include "solver/state.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "cloth/cloth.h"
#include "core/fnv.h"
#include "solver/step_params.h"

namespace clothsim {

State stateAtRest(const Cloth& cloth) {
  State state;
  state.positions.resize(cloth.particleCount());
  state.velocities.resize(cloth.particleCount());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const auto x = startPosition<float>(cloth, i);
    state.positions[i] = {x.x, x.y, x.z, static_cast<float>(cloth.inverseMasses()[i])};
  }
  return state;
}

void dropZeroSlips(State& state) {
  const auto isZero = [](const auto& slip) { return slip.x == 0 && slip.y == 0 && slip.z == 0; };
  if (std::ranges::all_of(state.elasticSlips, [&](const Particle4& s) { return isZero(s) && s.w == 0; }))
    state.elasticSlips.clear();
  if (std::ranges::all_of(state.pairSlips, [&](const PairSlip& s) { return isZero(s) && s.heldLimit == 0; }))
    state.pairSlips.clear();
}

void forgetHistory(State& state) {
  state.histories.clear();
  state.usualSteps = 0;
}

void leavePath(std::vector<std::uint32_t>& offPath, std::uint32_t particle) {
  const auto place = std::lower_bound(offPath.begin(), offPath.end(), particle);
  if (place == offPath.end() || *place != particle) offPath.insert(place, particle);
}

std::uint64_t stateHash(const State& state) {
  assert(state.positions.size() == state.velocities.size() && "every particle has a position and a velocity");
  Fnv1a hash;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Particle4& x = state.positions[i];
    const Particle4& v = state.velocities[i];
    for (const float component : {x.x, x.y, x.z, v.x, v.y, v.z}) hash.add(component);
  }
  return hash.value();
}

std::string hashText(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t digit = 16; digit-- > 0; hash >>= 4) text[digit] = "0123456789abcdef"[hash & 15];
  return text;
}

}  // namespace clothsim
