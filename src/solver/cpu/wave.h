// Passes that look at rows next to their own go down the rows of a grid as one wave: each works so many rows
// behind the first one that what it needs is there. Rows are still in the cache when the next pass comes to
// them, and none waits for the end of the one before. How far behind follows from what passes declare
// (pass.h). Threads take bands of rows (wave_bands.h).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/step_list.h"
#include "solver/step_params.h"

namespace clothsim::cpu {

// How many of the passes, from the first one on, can go down the rows of a grid together; at least 1.
[[nodiscard]] std::size_t waveLength(std::span<const PassCall> passes);

// A pass of a wave.
struct WavePass {
  PassCall call;
  const LimitColor* color;  // of `limit`; null for other passes
  int behind;               // rows that it is behind the first pass
  int inside;               // rows at the start of a band that it leaves to the band before
};

// The passes over one grid.
struct Wave {
  std::vector<WavePass> passes;
  int behind = 0, inside = 0;  // the most of all passes
};
// Colours that a grid does not have are left out. `colors` must outlive the wave.
[[nodiscard]] Wave makeWave(std::span<const PassCall> passes, std::span<const LimitColor> colors);

// Calls work(number of the pass, row) for what the passes do when the first of them is at row `front`: behind
// the last row, the others go on. isWanted(pass, row) says which rows there are.
template <class IsWanted, class Work>
void runFront(const Wave& wave, int front, const IsWanted& isWanted, const Work& work) {
  for (std::size_t k = 0; k < wave.passes.size(); ++k) {
    const int row = front - wave.passes[k].behind;
    if (isWanted(wave.passes[k], row)) work(k, row);
  }
}
// On all rows of a grid.
template <class Work>
void runWave(const Wave& wave, int rows, const Work& work) {
  const auto isOnGrid = [rows](const WavePass&, int row) { return row >= 0 && row < rows; };
  for (int front = 0; front < rows + wave.behind; ++front) runFront(wave, front, isOnGrid, work);
}

}  // namespace clothsim::cpu
