// A wave (wave.h) on several threads: each takes a band of rows. At the seam of two bands a pass of the lower
// one begins so many rows inside it that the band needs nothing of the upper one; the upper one goes on
// beyond its end, until it meets what the lower one did there, a while ago as a rule. Seams move to where
// both take equally long: a core may have other work, and a collider may lie under some of the rows.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <thread>

#include "core/spin.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/wave.h"

namespace clothsim::cpu {

template <class Real>
class WaveBands {
 public:
  // `count` bands, from 1 to `rows`, of a grid with so many rows. `wave` must outlive it.
  WaveBands(const Wave& wave, int rows, int count);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(bands_.size()); }

  // Before any thread runs a band.
  void begin();
  // Calls work(number of the pass, row, forces of rows) for the rows of a band, in their order; for none
  // where another thread has taken it. Any thread may run any band: what that needs of the next one is done
  // here unless another thread is at it. Returns false where memory for the forces of rows of so many columns
  // is lacking.
  template <class Work>
  [[nodiscard]] bool run(std::uint32_t number, int columns, const Work& work) {
    Band& band = bands_[number];
    if (band.isTaken.test_and_set(std::memory_order_relaxed)) return true;
    const Clock::time_point start = Clock::now();
    Clock::duration waited{};
    bool hasMemory = band.forces.begin(columns);
    const bool isLast = number + 1 == bands_.size();
    const int frontsEnd = (isLast ? rows_ : band.end + wave_->inside) + wave_->behind;
    const auto isInBand = [&](const WavePass& pass, int row) {
      return row >= startOf(band.first, pass) && row < startOf(band.end, pass);
    };
    for (int front = band.first; hasMemory && front < frontsEnd; ++front) {
      if (front >= band.end && !isLast && !isDone(bands_[number + 1], front)) {
        const Clock::time_point before = Clock::now();
        hasMemory = run(number + 1, columns, work);
        while (!spinUntil([&] { return isDone(bands_[number + 1], front); })) std::this_thread::yield();
        waited += Clock::now() - before;
      }
      runFront(*wave_, front, isInBand, [&](std::size_t k, int row) { work(k, row, band.forces); });
      band.fronts.store(front + 1, std::memory_order_release);
    }
    band.fronts.store(std::numeric_limits<int>::max(), std::memory_order_release);
    band.time = Clock::now() - start - waited;
    return hasMemory;
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct alignas(64) Band {
    int first, end;  // rows of the first pass
    ForceRows<Real> forces;
    std::atomic<int> fronts{0};  // before these all is done
    std::atomic_flag isTaken;
    Clock::duration time{};  // that it took last, without waiting
  };

  [[nodiscard]] static bool isDone(const Band& band, int front) {
    return band.fronts.load(std::memory_order_acquire) > front;
  }
  // The first row of a pass in the band whose first pass begins at a row.
  [[nodiscard]] int startOf(int first, const WavePass& pass) const {
    return first == 0 ? 0 : std::min(first + pass.inside, rows_);
  }

  const Wave* wave_;
  int rows_;
  std::deque<Band> bands_;
};

extern template class WaveBands<float>;
extern template class WaveBands<double>;

}  // namespace clothsim::cpu
