#include "solver/executor.h"

#include <algorithm>

namespace clothsim {

void addTime(std::vector<PassTime>& times, const std::string& name, double seconds) {
  auto found =
      std::find_if(times.begin(), times.end(), [&](const PassTime& time) { return time.name == name; });
  if (found == times.end()) found = times.insert(found, {name, 0});
  found->seconds += seconds;
}

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

}  // namespace clothsim
