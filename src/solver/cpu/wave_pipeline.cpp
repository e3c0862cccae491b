#include "solver/cpu/wave_pipeline.h"

#include <algorithm>

namespace clothsim::cpu {
namespace {

// What passes take, about, in times of a colour of the strain limit (perf record of the demo at 96 x 96:
// forces 17 %, three rounds of collisions 18 %, 36 colours 12 %); and the least work of a stage, so that
// taking it is worth it.
constexpr int COLOR_WORK = 1, LIGHT_WORK = 3, FORCES_WORK = 50, COLLIDE_WORK = 18, LEAST_STAGE = 12;

int workOf(const WavePass& pass) {
  if (pass.color != nullptr) return COLOR_WORK;
  if (pass.call.pass == Pass::forces) return FORCES_WORK;
  return pass.call.pass == Pass::collide ? COLLIDE_WORK : LIGHT_WORK;
}

}  // namespace

template <class Real>
WavePipeline<Real>::WavePipeline(const Wave& wave, int rows)
    : wave_(&wave), rows_(rows), end_(rows + wave.behind) {
  int work = LEAST_STAGE, most = 1, all = 0;
  for (std::size_t k = 0; k < wave.passes.size(); ++k) {
    if (work >= LEAST_STAGE) {
      stages_.emplace_back().passes = {k, k};
      work = 0;
    }
    stages_.back().passes.end = k + 1;
    work += workOf(wave.passes[k]);
    all += workOf(wave.passes[k]);
    most = std::max(most, work);
  }
  mostThreads_ = (all + most - 1) / most;
}

template <class Real>
void WavePipeline<Real>::begin() {
  for (Stage& stage : stages_) {
    stage.fronts.store(0, std::memory_order_relaxed);
    stage.isTaken.clear(std::memory_order_relaxed);  // whoever lacked memory left it taken
  }
}

template <class Real>
auto WavePipeline<Real>::take() -> Stage* {
  for (std::size_t s = stages_.size(); s-- > 0;) {
    Stage& stage = stages_[s];
    const auto mayGoOn = [&] {
      const int front = stage.fronts.load(std::memory_order_relaxed);
      return front < end_ && (s == 0 || stages_[s - 1].fronts.load(std::memory_order_acquire) > front);
    };
    if (!mayGoOn() || stage.isTaken.test_and_set(std::memory_order_acquire)) continue;
    if (mayGoOn()) return &stage;
    stage.isTaken.clear(std::memory_order_release);  // another thread has just gone on with it
  }
  return nullptr;
}

template class WavePipeline<float>;
template class WavePipeline<double>;

}  // namespace clothsim::cpu
