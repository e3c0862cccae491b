// An implicit step on the GPU (solver/implicit.h): from the state at the start of a step to the one before
// contacts. Nothing is read back.
#pragma once

#include <functional>
#include <vector>

#include "gl/buffer.h"
#include "solver/gpu/particle_array.h"
#include "solver/gpu/pass_programs.h"
#include "solver/gpu/pass_runner.h"
#include "solver/implicit.h"

namespace clothsim {

class GpuImplicit {
 public:
  using BindGrid = std::function<void(std::size_t)>;

  // `cloth` must outlive it. @throws OpenGlError when a buffer is larger than the driver allows
  GpuImplicit(const Cloth& cloth, bool wind);

  // Compiled for what each grid's scene needs. @throws OpenGlError when a shader does not compile
  void choosePrograms(PassLibrary& library, const std::vector<PassFeatures>& grids);
  [[nodiscard]] bool hasAirBlocks() const { return hasAirBlocks_; }
  // `cutMasks`: makeCutMasks().
  void setCutMasks(const std::vector<std::uint32_t>& cutMasks);

  // Solves all grids at once. The state is bound, `positions` is that at the start of the step, and
  // `bindGrid(grid)` binds the parameters of a grid.
  void run(PassRunner& runner, const SolverSettings& settings, const ParticleArray& positions,
           const BindGrid& bindGrid);

 private:
  struct alignas(256) LevelSlot {  // every driver takes uniform offsets in multiples of 256
    LevelParams<float> params;
  };
  struct GridPrograms {
    const gl::Program *begin = nullptr, *forces = nullptr, *linearize = nullptr, *multiply = nullptr,
                      *tryLengths = nullptr, *end = nullptr;
  };
  struct Programs {
    const gl::Program *coarsen = nullptr, *restrict = nullptr, *prolong = nullptr, *solveCoarsest = nullptr,
                      *direct = nullptr, *advance = nullptr, *accept = nullptr;
    const gl::Program *sumBlocks[4] = {}, *sumTotals[4] = {};  // by SUM_...
  };
  struct Run {  // of a step
    PassRunner& runner;
    const BindGrid& bindGrid;
  };

  void onGrids(const Run& run, const gl::Program* GridPrograms::*pass, const char* name) const;
  void onParticles(const Run& run, const gl::Program& pass, const char* name) const;
  void onCoarse(const Run& run, const gl::Program& pass, const char* name, std::size_t slot) const;
  void linearize(const Run& run) const;
  void precondition(const Run& run) const;
  void sum(const Run& run, int kind) const;
  void iterate(const Run& run, int iterations) const;
  void searchLine(const Run& run) const;

  const Cloth* cloth_;
  Hierarchy<float> hierarchy_;
  std::vector<std::size_t>
      firstSlots_;  // of each grid's levels in levels_; the last one of all grids' without any
  std::vector<GridPrograms> gridPrograms_;
  Programs programs_;
  bool hasAirBlocks_;

  gl::Buffer<LevelSlot> levels_;
  ParticleArray residuals_, corrections_, factors_, blocks_, anchors_, airBlocks_, ways_, iterates_,
      directions_, products_, increments_, partialSums_;
  gl::Buffer<ImplicitScalars<float>> scalars_;
  gl::Buffer<std::uint32_t> cutLinks_;  // once there were cuts
  gl::BufferTexture cutLinksTexture_;
};

}  // namespace clothsim
