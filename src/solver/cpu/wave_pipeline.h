// A wave (wave.h) on several threads, for a grid that has too few rows for a band a thread: its passes are
// cut into stages, and each stage goes down the rows behind the one before it. A thread takes the next few
// rows of whatever stage may go on, so that none waits for a certain other one.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>

#include "core/spin.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/wave.h"

namespace clothsim::cpu {

template <class Real>
class WavePipeline {
 public:
  // Of a grid with so many rows. `wave` must outlive it.
  WavePipeline(const Wave& wave, int rows);

  [[nodiscard]] std::size_t stages() const { return stages_.size(); }
  // That it keeps busy, the last one perhaps in part.
  [[nodiscard]] int mostThreads() const { return mostThreads_; }

  // Before any thread runs it.
  void begin();
  // For each thread: work(number of the pass, row, forces of rows), each once, until all is done or other
  // threads are at what is left. Returns false where memory for the forces of rows of so many columns is
  // lacking.
  template <class Work>
  [[nodiscard]] bool run(int columns, Work work) {
    while (!isDone()) {
      Stage* stage = nullptr;
      spinUntil([&] { return (stage = take()) != nullptr || isDone(); });
      if (stage == nullptr) return true;
      const int front = stage->fronts.load(std::memory_order_relaxed);
      if (front == 0 && !stage->forces.begin(columns)) return false;
      runFronts(*wave_, stage->passes, front, front + FRONTS_AT_ONCE, rows_,
                [&](std::size_t k, int row) { work(k, row, stage->forces); });
      stage->fronts.store(front + FRONTS_AT_ONCE, std::memory_order_release);
      stage->isTaken.clear(std::memory_order_release);
    }
    return true;
  }

 private:
  // A thread comes back for more after so many rows.
  static constexpr int FRONTS_AT_ONCE = 8;

  struct alignas(64) Stage {
    PassRange passes{};
    ForceRows<Real> forces;
    std::atomic<int> fronts{0};  // that are done
    std::atomic_flag isTaken;    // by a thread, which alone goes on with it
  };

  [[nodiscard]] bool isDone() const { return stages_.back().fronts.load(std::memory_order_acquire) >= end_; }
  // The last stage that may go on, now this thread's; null where there is none.
  [[nodiscard]] Stage* take();

  const Wave* wave_;
  int rows_;
  int end_;  // fronts of each stage
  int mostThreads_ = 1;
  std::deque<Stage> stages_;
};

extern template class WavePipeline<float>;
extern template class WavePipeline<double>;

}  // namespace clothsim::cpu
