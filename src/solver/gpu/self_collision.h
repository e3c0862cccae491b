// Self-collision on the GPU: the twin of solver/cpu/self_collision.h, passes under shaders/sim/self/.
// Building the hash is dispatched in every step with as many work groups as the GPU itself has found to be
// needed, none in most steps: nothing is read back.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cloth/cloth.h"
#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/program.h"
#include "scene/scene.h"
#include "solver/executor.h"
#include "solver/gpu/arrays.h"
#include "solver/gpu/particle_array.h"
#include "solver/gpu/pass_runner.h"
#include "solver/self_collision.h"

namespace clothsim {

class GpuSelfCollision {
 public:
  using BindPiece = std::function<void(std::size_t)>;

  // `cloth` must outlive it.
  GpuSelfCollision(const Cloth& cloth, int groupColumns, int groupRows);

  // @throws OpenGlError when a buffer is larger than the driver allows, or a shader does not compile
  void configure(const Scene& scene);
  [[nodiscard]] bool isOn() const { return mode_ != SelfCollision::off; }
  [[nodiscard]] bool isRobust() const { return mode_ == SelfCollision::robust; }

  // Does a pass of Domain::contacts. Building the hash and finding candidates are dispatched with no work
  // groups where there is no need.
  void run(PassRunner& runner, PassCall call, GpuArrays& arrays, const BindPiece& bindPiece);
  // Whether the masks of cuts are bound in the passes. Forgets the hash.
  void setCut(bool cut);
  // For a new state: forgets the hash. The counts go on.
  void restart();
  // After divergence in some step no contacts are looked for, until this.
  void forgetDivergence();

  [[nodiscard]] ContactCounts counts() const;
  void forgetCounts();

 private:
  struct Flags {  // as ContactFlags in shaders/sim/self/common.glsl
    std::uint32_t stale = 1, fast = 0, tooNear = 0, clamping = 0, hashBuilds = 0, fastSteps = 0,
                  clampedSteps = 0, broken = 0, groupsDone = 0;
  };
  struct Variant {  // of a program
    bool robust = false, nearCodes = false, cuts = false, mesh = false, seams = false;
    friend auto operator<=>(const Variant&, const Variant&) = default;
  };
  struct Programs {
    const gl::Program *check = nullptr, *count = nullptr, *scanBuckets = nullptr, *scatter = nullptr,
                      *find = nullptr, *resolve = nullptr, *checkMotion = nullptr, *clamp = nullptr;
  };
  // Places in the dispatch buffer; those of `find` follow, one a grid.
  enum Place : std::size_t { countPlace, scanBucketsPlace, scatterPlace, findPlace };

  const gl::Program* program(const std::string& pass, const Variant& variant);
  void choosePrograms();
  void allocate(const SelfParams<float>& params);
  [[nodiscard]] Groups gridGroups(const Piece& piece) const;
  void bind() const;
  void buildHash(PassRunner& runner, const std::string& name, const ParticleArray& positions) const;
  void findCandidates(PassRunner& runner, const std::string& name, const BindPiece& bindPiece) const;
  void runOnPieces(PassRunner& runner, const gl::Program& pass, const std::string& name,
                   const BindPiece& bindPiece) const;

  const Cloth* cloth_;
  int groupColumns_, groupRows_;
  SelfCollision mode_ = SelfCollision::off;
  bool hasNearCodes_ = false, isCut_ = false, canTear_ = false;
  std::map<std::pair<std::string, Variant>, gl::Program> programs_;  // all that were ever needed,
  Programs now_;                                                     // those in use

  gl::Buffer<SelfParams<float>> params_;
  gl::Buffer<float> distances_;
  gl::Buffer<Flags> flags_;
  gl::Buffer<Groups> dispatches_;
  gl::Buffer<std::uint32_t> bucketCounts_, buckets_, bucketBlocks_, candidates_;
  ParticleArray hashed_, sorted_;
  gl::BufferTexture distancesTexture_, bucketsTexture_, bucketBlocksTexture_, candidatesTexture_;
};

}  // namespace clothsim
