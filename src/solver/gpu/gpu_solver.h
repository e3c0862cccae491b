// The GPU backend: compute passes over storage buffers, from which the renderer draws. A step neither
// allocates, reads back nor compiles; its parameters are uploaded ahead, for many steps at once.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/context.h"
#include "gl/program.h"
#include "solver/gpu/hand.h"
#include "solver/gpu/implicit.h"
#include "solver/gpu/mesh_lists.h"
#include "solver/gpu/particle_array.h"
#include "solver/gpu/pass_programs.h"
#include "solver/gpu/pass_runner.h"
#include "solver/gpu/self_collision.h"
#include "solver/pin_paths.h"
#include "solver/solver.h"
#include "solver/step_params.h"

namespace clothsim {

struct GpuOptions {
  bool fused = true;  // forces, integration and colliders in one dispatch; the bits are the same either way
  int groupColumns = 64;  // work group, in grid points
  int groupRows = 1;
};

class GpuSolver final : public Solver {
 public:
  // Needs a current context; `cloth` must outlive the solver. @throws OpenGlError when a buffer is larger
  // than the driver allows, memory runs out, or a shader does not compile
  GpuSolver(const Cloth& cloth, const Scene& scene, const GpuOptions& options = {});

  void configure(const Scene& scene) override;
  void step(int count) override;
  void finish() override;
  [[nodiscard]] std::optional<Trouble> trouble() override;
  [[nodiscard]] std::unique_ptr<Snapshot> snapshot(std::unique_ptr<Snapshot> reuse) override;
  void restore(const Snapshot& snapshot) override;
  [[nodiscard]] State state() override;
  void setState(const State& state) override;
  void convertVelocities() override;
  [[nodiscard]] std::vector<Particle4> positions(std::uint32_t first, std::uint32_t count) override;
  void setHand(const Hand& hand) override;
  void setCuts(const Cuts& cuts) override;
  [[nodiscard]] const Cuts& cuts() const override { return cuts_.cuts(); }
  void setPin(std::uint32_t particle, bool pinned) override;
  [[nodiscard]] const StepClock& clock() const override { return clock_; }
  [[nodiscard]] ContactCounts contactCounts() override { return selfCollision_.counts(); }
  [[nodiscard]] std::string backend() const override { return "gpu"; }
  [[nodiscard]] std::string device() const override;

  // One vec4 a particle: xyz and the inverse mass. The name changes from step to step (two buffers in turn).
  [[nodiscard]] GLuint positionsBuffer() const { return positions_[now_].buffer.name(); }

  // Steps with a timer query around every dispatch (which slows the whole) and adds up by pass.
  [[nodiscard]] std::vector<PassTime> timePasses(int steps);

 private:
  struct alignas(256) StepSlot {  // every driver takes uniform offsets in multiples of 256
    StepParams<float> params;
  };
  struct alignas(256) ColorSlot {
    LimitColor color;
  };
  struct alignas(256) WatchSlot {  // as every driver takes storage offsets
    WatchRow row;
  };
  struct GridColors {  // a grid's part of limitColors_
    std::size_t first = 0;
    std::vector<LimitColor> colors;
  };

  void choosePrograms();
  void preparePins();
  void uploadParams(int count);
  void bindWatch();
  void forgetTrouble();
  void checkStart();
  void bindState();
  void stepOnce(std::size_t batchStep);
  void limitStrain(std::size_t grid);
  void run(const gl::Program& pass, const char* name, const Grid& grid);

  const Cloth* cloth_;
  Scene scene_;
  GpuOptions options_;
  Integrator velocityMeaning_;
  StepClock clock_;
  bool paramsUploaded_ = false;  // for every step, when nothing depends on time

  PassLibrary library_;
  std::vector<PassPrograms> gridPrograms_;  // those in use, by grid
  std::array<ParticleArray, 2> positions_, velocities_;
  std::size_t now_ = 0;  // which of the two holds the state
  gl::Buffer<Particle4> forces_;
  gl::Buffer<float> restLengths_;
  gl::BufferTexture restLengthTexture_;
  GpuMeshLists lists_;
  gl::Buffer<StepSlot> stepSlots_;               // a batch of steps, each with all grids
  gl::Buffer<ColliderParams<float>> colliders_;  // the same batch, each with all colliders
  gl::BufferTexture colliderTexture_;
  PinPaths pinPaths_;
  std::vector<std::uint32_t> offPath_;
  gl::Buffer<Particle4> pinStarts_;  // xyz and the number of the path + 1; one unused element without paths
  gl::BufferTexture pinStartTexture_;
  gl::Buffer<PinMotionParams<float>> pinMotions_;  // the same batch, each with all paths
  gl::BufferTexture pinMotionTexture_;
  ColliderSet colliderSet_;
  gl::Buffer<float> distances_;  // samples of the mesh colliders' grids
  gl::BufferTexture distanceTexture_;
  gl::Buffer<ColorSlot> limitColors_;
  std::vector<GridColors> gridColors_;
  std::vector<StepSlot> stagedSlots_;
  std::vector<ColliderParams<float>> stagedColliders_;
  std::vector<PinMotionParams<float>> stagedPinMotions_;
  GpuHand hand_;
  GpuCuts cuts_;
  std::optional<GpuImplicit> implicit_;  // once it was needed
  GpuSelfCollision selfCollision_;
  PassRunner runner_;

  gl::Buffer<WatchSlot> watch_;     // a row a step since watchBase_
  std::uint64_t watchBase_ = 0;     // the step whose row is the first one; steps before it were sound
  std::optional<Trouble> trouble_;  // as far as it was looked for
  bool startChecked_ = true;        // false once a state was handed in
};

}  // namespace clothsim
