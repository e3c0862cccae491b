// Executes passes on the GPU: compute shaders over storage buffers, from which the renderer draws.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/mapped_buffer.h"
#include "gl/program.h"
#include "solver/executor.h"
#include "solver/gpu/arrays.h"
#include "solver/gpu/levels.h"
#include "solver/gpu/mesh_lists.h"
#include "solver/gpu/parameters.h"
#include "solver/gpu/pass_programs.h"
#include "solver/gpu/pass_runner.h"
#include "solver/gpu/self_collision.h"
#include "solver/gpu/surface_contact.h"
#include "solver/gpu/watch.h"

namespace clothsim {

// When the host looks at the flags that say whether a step or its linear system is solved. When ready: at a
// copy that was asked for behind each Newton step and now and then within one, once it is there; nothing
// waits, and meanwhile passes are dispatched that may do nothing. Always: before each pass, which waits.
enum class FlagLooks { never, whenReady, always };

struct GpuOptions {
  bool fused = true;  // passes that share a sweep in one dispatch, where there is a kernel for them; the bits
                      // are the same either way
  int groupColumns = 0;  // work group, in grid points; 0: as suits the device
  int groupRows = 1;
  // One work group takes all levels of at most `verticesAlone` vertices, but for the finest, with
  // `coarseLanes` invocations; 0: as many as suit the device. 1024 hold the coarsest level's matrix in
  // registers while it is inverted.
  int coarseLanes = 0;
  std::uint32_t verticesAlone = 16384;
  // The strain limit of grids in tiles of shared memory, all colours in one dispatch; empty: where OpenGL is
  // hardware. A software renderer has slow shared memory.
  std::optional<bool> limitsInTiles = {};
  // The matrices of coarse levels beyond the first by a work group a block, with what its sources add in
  // shared memory; empty: where OpenGL is hardware.
  std::optional<bool> coarsensInGroups = {};
  // The state at the start of a step is read from storage blocks instead of as texels; empty: where OpenGL is
  // hardware. A software renderer is faster at texels.
  std::optional<bool> storageLoads = {};
  // Passes that would do nothing, because the step or the linear system is solved, are not even dispatched
  // where the flags are looked at. Empty: always on a software renderer, which has set them by then, and when
  // ready on hardware.
  std::optional<FlagLooks> looksAtFlags = {};
};

class GpuExecutor final : public Executor {
 public:
  // Needs a current context; `cloth` must outlive it. @throws OpenGlError when a buffer is larger than the
  // driver allows, memory runs out, or a shader does not compile
  GpuExecutor(const Cloth& cloth, const GpuOptions& options);

  void prepare(const StepInputs& inputs, const PassList& list) override;
  void setScene(const StepInputs& inputs) override;
  void setCuts(const StepInputs& inputs) override;
  void run(const StepInputs& inputs, const PassList& list, int steps) override;
  void flush() override;
  void finish() override;
  void upload(const State& state) override;
  void download(State& state) override;
  [[nodiscard]] std::vector<Particle4> positions(std::uint32_t first, std::uint32_t count) override;
  void setInverseMass(std::uint32_t particle, double inverseMass, bool rests) override;
  [[nodiscard]] std::unique_ptr<ParticleCopy> copy(std::unique_ptr<ParticleCopy> reuse) override;
  [[nodiscard]] bool restore(const ParticleCopy& copy) override;
  void forgetHistory() override;
  [[nodiscard]] std::optional<Divergence> findDivergence(std::uint64_t step, bool wait) override;
  [[nodiscard]] bool mayLackRoom() const override { return surfaceContact_.isOn(); }
  void keepCounts() override;
  void restoreCounts() override;
  [[nodiscard]] bool lackedRoom() override { return std::exchange(lackedRoom_, false); }
  void forgetDivergence(std::uint64_t step) override;
  [[nodiscard]] ContactCounts contactCounts() override {
    return selfCollision_.counts() + surfaceContact_.counts();
  }
  [[nodiscard]] ConvergenceCounts convergenceCounts() override;
  void forgetContactCounts() override {
    selfCollision_.forgetCounts();
    surfaceContact_.forgetCounts();
  }
  void startTiming() override;
  [[nodiscard]] std::vector<PassTime> stopTiming() override;
  [[nodiscard]] std::string backend() const override { return "gpu"; }
  [[nodiscard]] std::string device() const override;

  // One vec4 a particle: xyz and the inverse mass. The name changes from step to step (two buffers in turn).
  [[nodiscard]] GLuint positionsBuffer() const { return arrays_[Array::positions].buffer.name(); }

 private:
  using StagePrograms = std::vector<const gl::Program*>;  // of one shader of a kernel, one a cloth
  struct alignas(256) ColorSlot {  // every driver takes uniform offsets in multiples of 256
    LimitColor color;
  };
  struct Copy;

  void setSurface(const StepInputs& inputs);
  void compile(const StepInputs& inputs, const PassList& list);
  [[nodiscard]] KernelChoice choose(std::span<const PassCall> passes) const;
  void runKernel(std::size_t kernel, std::span<const PassCall> passes);
  [[nodiscard]] bool isClosed(Gate gate);
  [[nodiscard]] bool hasElasticSlips() const;
  void lookAtFlags();
  void askForFlags(std::span<const PassCall> passes);
  // A stage of a kernel, with its programs by piece.
  void runStage(Over over, const StagePrograms& programs, const PassCall& call, const std::string& name);
  void runOnGrids(const StagePrograms& programs, const PassCall& call, const std::string& name);
  void runOnColor(const StagePrograms& programs, std::size_t color, const std::string& name);
  void runOnTiles(const StagePrograms& programs, const std::string& name);
  void runOnSlot(const StagePrograms& programs, std::size_t firstColor, const std::string& name);
  void runOnLevel(const StagePrograms& programs, const PassCall& call, const std::string& name);
  void runOnBlocks(const StagePrograms& programs, std::size_t index, const std::string& name);
  void runRestrictions(const StagePrograms& programs, const std::string& name);
  void runProlongations(const StagePrograms& programs, const std::string& name);
  void runOnEntries(const gl::Program& program, const std::string& name, std::uint32_t count);

  const Cloth* cloth_;
  GpuOptions options_;
  GpuArrays arrays_;
  GpuParameters parameters_;
  GpuMeshLists lists_;
  gl::Buffer<float> restLengths_, distances_;  // distances_: samples of the mesh colliders' grids
  gl::Buffer<std::uint32_t> cutMasks_;
  gl::BufferTexture restLengthTexture_, distanceTexture_, cutMaskTexture_;
  std::shared_ptr<const std::vector<float>> stagedDistances_;  // those in distances_

  std::vector<std::vector<LimitColor>> colors_;  // by grid,
  std::vector<std::size_t> firstColors_;         // and where they begin in
  gl::Buffer<ColorSlot> colorSlots_;
  KernelOptions kernelOptions_;
  GpuLevels levels_;  // empty until an implicit step needs them

  PassLibrary library_;
  std::vector<std::vector<StagePrograms>> kernels_;  // by kernel and shader; empty where no list needs it
  GpuSelfCollision selfCollision_;
  GpuSurfaceContact surfaceContact_;
  PassRunner runner_;

  std::optional<ImplicitScalars<float>> seen_;  // what no pass has written since
  // The newest copy of the flags that was asked for, and what copies have said.
  gl::MappedBuffer<ImplicitScalars<float>> flags_;
  gl::Fence flagsAreThere_;
  bool areOfThisSystem_ = false;  // that copy's
  bool isStepKnownSolved_ = false, isSystemKnownSolved_ = false;
  int iterationsUnseen_ = 0;

  GpuWatch watch_;
  bool lackedRoom_ = false;
};

}  // namespace clothsim
