// Runs those passes on the CPU that go down the rows of a cloth, on all threads: several in one go where they
// allow it (wave.h).
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/piece_ranges.h"
#include "solver/cpu/wave.h"
#include "solver/cpu/wave_bands.h"

namespace clothsim::cpu {

template <class Real>
class RowPasses {
 public:
  explicit RowPasses(const Cloth& cloth);  // which must outlive it

  // One sweep, or one wave, over all cloths; `pieces` are what passes get, by cloth. @throws std::bad_alloc
  void run(std::span<const PassCall> passes, const std::vector<ImplicitArguments<Real>>& pieces);

 private:
  // What a pass does with one row of a grid, or of a mesh (rows.h).
  using RowPass = void (*)(const ImplicitArguments<Real>&, int row, ForceRows<Real>&);
  // A wave, which does not change from step to step.
  struct Plan {
    std::vector<PassCall> passes;
    std::size_t piece = 0;
    Wave wave;
    std::vector<RowPass> works;            // by pass of the wave; null for colours
    std::optional<WaveBands<Real>> bands;  // as many as were wanted last

    // Pass k of the wave on one row.
    void run(std::size_t k, const ImplicitArguments<Real>& arguments, int row, ForceRows<Real>& forces) const;
  };

  [[nodiscard]] static RowPass rowPassOf(Pass pass);
  [[nodiscard]] Plan& planOf(std::span<const PassCall> passes, std::size_t piece);
  // How many threads a grid keeps busy.
  [[nodiscard]] int threadsFor(const Piece& lattice) const;
  // Several cloths that are too small for bands, each by one thread. False, and nothing is done, where one is
  // large or a mesh, or all are next to nothing.
  [[nodiscard]] bool runWaves(std::span<const PassCall> passes,
                              std::span<const ImplicitArguments<Real>> pieces);
  void runOn(std::size_t piece, std::span<const PassCall> passes,
             std::span<const ImplicitArguments<Real>> pieces);
  // All rows of a pass, or a sweep, before the next one.
  void runOneByOne(std::size_t piece, std::span<const PassCall> passes,
                   std::span<const ImplicitArguments<Real>> pieces);
  // Of the cloths [first, end).
  void runSweep(std::span<const PassCall> passes, std::span<const ImplicitArguments<Real>> pieces,
                std::size_t first, std::size_t end);
  // The rows of a wave on the calling thread, or in bands on all threads. False where memory is lacking.
  [[nodiscard]] bool runAlone(const Plan& plan, const ImplicitArguments<Real>& arguments) const;
  [[nodiscard]] bool runInBands(Plan& plan, int count, const ImplicitArguments<Real>& arguments) const;
  void runColor(std::size_t piece, const LimitColor& color, const ImplicitArguments<Real>& arguments);

  const Cloth* cloth_;
  std::vector<std::vector<LimitColor>> limitColors_;  // by cloth
  std::vector<std::deque<Plan>> plans_;               // by cloth
  PieceRanges rows_;                                  // of all cloths
  std::vector<std::uint32_t> rowStarts_;              // number of a cloth's first row there, and one more
  std::uint32_t rowsAtOnce_ = 1;                      // that a thread takes
  std::vector<const Plan*> waves_;                    // that are run side by side
  std::vector<RowPass> works_;                        // of the sweep that is run
};

extern template class RowPasses<float>;
extern template class RowPasses<double>;

}  // namespace clothsim::cpu
