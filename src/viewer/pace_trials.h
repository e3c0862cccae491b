// Tries what may help a scene to its pace: each remedy is simulated for a moment from the state that the
// scene has now, one after the other, on a thread of its own, while nothing else is stepped.
#pragma once

#include <memory>
#include <vector>

#include "cloth/cloth.h"
#include "core/shared.h"
#include "solver/state.h"
#include "viewer/pace_advice.h"

namespace clothsim {

// A state for another grid: in between by weights of the four particles around it. Cloths that are no single
// grids, and grids of the same size, take it as it is.
[[nodiscard]] State resampled(const State& state, const Cloth& from, const Cloth& to);

// Simulated seconds per second of the scene on the CPU, from that state of the cloth `from`; 0 where it
// cannot go on from there. Takes about a third of a second, and two steps at least.
[[nodiscard]] double measuredPace(const Shared<Scene>& scene, const Cloth& from, const State& state);

class PaceTrials {
 public:
  // Begins, and ends once two have come to the wanted pace [simulated seconds per second]. What is not
  // simulated here is not tried: another quality, the GPU, slow motion.
  void start(std::vector<PaceRemedy> remedies, const Shared<Scene>& scene, const Shared<Cloth>& cloth,
             State state, double wanted);
  [[nodiscard]] bool isRunning() const { return work_ != nullptr; }  // until take() or abandon()
  [[nodiscard]] bool isDone() const;
  // Those that have been tried, and those that need not be.
  [[nodiscard]] std::vector<PaceRemedy> take();
  // Its thread ends after the remedy that it tries.
  void abandon();

 private:
  struct Work;
  std::shared_ptr<Work> work_;
};

}  // namespace clothsim
