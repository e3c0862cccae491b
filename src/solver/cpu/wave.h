// Passes that look at rows next to their own go down the rows of a grid as one wave: each works so many rows
// behind the first one that what it needs is there. Rows are still in the cache when the next pass comes to
// them, and none waits for the end of the one before. How far behind follows from what passes declare
// (pass.h).
//
// Threads take bands of rows. At the seam of two bands each pass stops so many rows before the end of the
// one, and begins so many rows behind the start of the other, that it needs nothing of its neighbour; what is
// left between them is done once both are.
#pragma once

#include <algorithm>
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
  int behind;               // rows that it is behind the first pass, and that it leaves at the end of a band
  int inside;               // rows that it leaves at the start of a band
};

// The passes over one grid.
struct Wave {
  std::vector<WavePass> passes;
  int behind = 0, inside = 0;  // the most of all passes

  // In bands of so many rows no two seams have a row in common, nor rows that springs join.
  [[nodiscard]] int leastBand() const { return behind + inside + 8; }
};
// Colours that a grid does not have are left out. `colors` must outlive the wave.
[[nodiscard]] Wave makeWave(std::span<const PassCall> passes, std::span<const LimitColor> colors);

// Passes of a wave [first, end), by number.
struct PassRange {
  std::size_t first, end;
};

// Calls work(number of the pass, row) while the first pass of the wave goes down rows [first, end) of a grid
// with `rows` of them. The passes behind it need it to go on beyond the last row.
template <class Work>
void runFronts(const Wave& wave, PassRange passes, int first, int end, int rows, Work work) {
  for (int front = first; front < end; ++front)
    for (std::size_t k = passes.first; k < passes.end; ++k) {
      const int row = front - wave.passes[k].behind;
      if (row >= 0 && row < rows) work(k, row);
    }
}
// Calls work(number of the pass, row) for rows [first, end) of a grid with so many rows, except for what its
// seams leave.
template <class Work>
void runBand(const Wave& wave, int first, int end, int rows, Work work) {
  for (int front = first; front < end + wave.behind; ++front)
    for (std::size_t k = 0; k < wave.passes.size(); ++k) {
      const WavePass& pass = wave.passes[k];
      const int row = front - pass.behind;
      const int begin = first == 0 ? 0 : first + pass.inside, stop = end == rows ? rows : end - pass.behind;
      if (row >= begin && row < stop) work(k, row);
    }
}
// What is left where the bands before and from row `seam` on meet.
template <class Work>
void runSeam(const Wave& wave, int seam, Work work) {
  for (std::size_t k = 0; k < wave.passes.size(); ++k)
    for (int row = seam - wave.passes[k].behind; row < seam + wave.passes[k].inside; ++row) work(k, row);
}

}  // namespace clothsim::cpu
