#include "solver/cpu/roof.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

#include "core/thread_team.h"
#include "core/vector_clones.h"

namespace clothsim::cpu {
namespace {

constexpr int RUNS = 9;
constexpr double LEAST_SECONDS = 0.01;  // of a run

// How often a second `work` runs, at best.
template <class Work>
double bestRate(const Work& work) {
  using Clock = std::chrono::steady_clock;
  double best = 0;
  for (int run = 0, times = 1; run < RUNS;) {
    const Clock::time_point begin = Clock::now();
    for (int i = 0; i < times; ++i) work();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (seconds < LEAST_SECONDS) {
      times *= 2;
      continue;
    }
    best = std::max(best, times / seconds);
    ++run;
  }
  return best;
}

// Scaled, so that the compiler does not call a copy that goes past the cache.
INLINE void scaleRange(const float* from, float* to, std::size_t begin, std::size_t end) {
#pragma GCC ivdep
  for (std::size_t i = begin; i < end; ++i) to[i] = 0.5f * from[i];
}
VECTOR_CLONES(void, scale, (const float* from, float* to, std::size_t begin, std::size_t end),
              (from, to, begin, end), scaleRange(from, to, begin, end))

constexpr int NUMBERS = 1024;  // in the nearest cache
// A multiplication and an addition each, in registers. Of longer chains a core does not see enough at once to
// hide how long they take.
constexpr int STEPS = 4;
constexpr int ROUNDS = 1024;  // over all numbers, a stretch of work

INLINE void multiplyAndAddAll(float* values, float factor) {
  for (int round = 0; round < ROUNDS; ++round)
#pragma GCC ivdep
    for (int k = 0; k < NUMBERS; ++k) {
      float x = values[k];
#pragma GCC unroll 4
      for (int step = 0; step < STEPS; ++step) x = x * factor + 1.0f;
      values[k] = x;
    }
}
VECTOR_CLONES(void, multiplyAndAdd, (float* values, float factor), (values, factor),
              multiplyAndAddAll(values, factor))

}  // namespace

double measureCopying(std::size_t bytes) {
  constexpr std::uint32_t block = 4096;
  const auto blocks =
      static_cast<std::uint32_t>(std::max<std::size_t>(1, bytes / (2 * sizeof(float) * block)));
  std::vector<float> from(std::size_t{blocks} * block, 1.0f), to(from.size());
  const double copies = bestRate([&] {
    ThreadTeam::shared().forEachRange(0, blocks, 1, [&](std::uint32_t begin, std::uint32_t end) {
      scale(from.data(), to.data(), std::size_t{begin} * block, std::size_t{end} * block);
    });
  });
  return copies * 2 * sizeof(float) * static_cast<double>(from.size());
}

double measureArithmetic() {
  const auto stretches = static_cast<std::uint32_t>(4 * ThreadTeam::shared().threads());
  std::atomic<float> result = 0;
  const double rate = bestRate([&] {
    ThreadTeam::shared().forEach(0, stretches, 1, [&](std::uint32_t k) {
      alignas(64) float values[NUMBERS]{};
      multiplyAndAdd(values, 0.5f);
      result.store(values[k % NUMBERS], std::memory_order_relaxed);  // so that it has to be computed
    });
  });
  return rate * stretches * ROUNDS * NUMBERS * 2 * STEPS;
}

}  // namespace clothsim::cpu
