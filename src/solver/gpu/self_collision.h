// Self-collision on the GPU: the twin of solver/cpu/self_collision.h, passes under shaders/sim/self/.
// Building the hash is dispatched in every step with as many work groups as the GPU itself has found to be
// needed, none in most steps: nothing is read back.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "cloth/cloth.h"
#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/program.h"
#include "scene/scene.h"
#include "solver/gpu/particle_array.h"
#include "solver/gpu/pass_runner.h"
#include "solver/self_collision.h"
#include "solver/solver.h"

namespace clothsim {

class GpuSelfCollision {
 public:
  using BindGrid = std::function<void(std::size_t)>;

  // `cloth` must outlive it.
  GpuSelfCollision(const Cloth& cloth, int groupColumns, int groupRows);

  // @throws OpenGlError when a buffer is larger than the driver allows, or a shader does not compile
  void configure(const Scene& scene);
  [[nodiscard]] bool isOn() const { return mode_ != SelfCollision::off; }
  [[nodiscard]] bool isRobust() const { return mode_ == SelfCollision::robust; }

  // Pass 3 over the positions at the end of the step, which it exchanges for corrected ones. The state is
  // bound, and `bindGrid(grid)` binds the parameters of a grid.
  void separate(PassRunner& runner, ParticleArray& newPositions, const BindGrid& bindGrid);
  // Robust only: cuts motion short where strangers came nearer than D; in place. `positions`: at the start of
  // the step.
  void guard(PassRunner& runner, const ParticleArray& positions, const BindGrid& bindGrid);
  // Whether the masks of cuts are bound in the passes. Forgets the hash.
  void setCut(bool cut);
  // For a new state: forgets the hash.
  void restart();

  [[nodiscard]] ContactCounts counts() const;

 private:
  struct Flags {  // as ContactFlags in shaders/sim/self/common.glsl
    std::uint32_t stale = 1, fast = 0, tooNear = 0, guarding = 0, hashBuilds = 0, fastSteps = 0,
                  guardedSteps = 0;
  };
  struct Programs {
    Programs(bool robust, bool nearCodes, bool cuts, int groupColumns, int groupRows);

    gl::Program check, plan, clear, count, scanBlocks, scanTotals, scatter, find, separate, guardCheck, guard;
  };
  // Places in the dispatch buffer; those of `find` follow, one a grid.
  enum Place : std::size_t {
    clearPlace,
    countPlace,
    scanBlocksPlace,
    scanTotalsPlace,
    scatterPlace,
    findPlace
  };

  void choosePrograms();
  void allocate(const SelfParams<float>& params);
  void bind() const;
  void buildHash(PassRunner& runner, const ParticleArray& positions, const BindGrid& bindGrid) const;
  void runOnGrids(PassRunner& runner, const gl::Program& pass, const char* name,
                  const BindGrid& bindGrid) const;

  const Cloth* cloth_;
  int groupColumns_, groupRows_;
  SelfCollision mode_ = SelfCollision::off;
  bool hasNearCodes_ = false, cut_ = false;
  using Variant = std::array<bool, 3>;  // robust, near codes, cuts
  std::map<Variant, Programs> programs_;
  const Programs* now_ = nullptr;  // those in use

  gl::Buffer<SelfParams<float>> params_;
  gl::Buffer<float> distances_;
  gl::Buffer<Flags> flags_;
  gl::Buffer<Groups> dispatches_;
  gl::Buffer<std::uint32_t> buckets_, bucketBlocks_, candidates_;
  ParticleArray hashed_, sorted_, spare_;
  gl::BufferTexture distancesTexture_, bucketsTexture_, bucketBlocksTexture_, candidatesTexture_;
};

}  // namespace clothsim
