// What passes on the GPU read besides the particles: the parameters of steps, uploaded ahead for many steps
// at once, and what is grabbed.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "solver/step_inputs.h"

namespace clothsim {

class GpuParameters {
 public:
  // After any change of the inputs but the clock. @throws OpenGlError when memory runs out
  void prepare(const StepInputs& inputs);
  // Makes sure that the parameters of the next step are there, and binds what is the same for all grids.
  // `steps`: how many steps may follow with these inputs.
  void bind(const StepInputs& inputs, int steps);
  // Those of a grid.
  void bindPiece(std::size_t piece) const;

 private:
  struct alignas(256) StepSlot {  // every driver takes uniform offsets in multiples of 256
    StepParams<float> params;
  };
  struct alignas(256) InteractionSlot {
    InteractionParams<float> params;
  };

  void preparePins(const PinPaths& paths, const Cloth& cloth, std::size_t batch);
  void prepareExternalForces(const Interaction& interaction);
  void prepareInteraction(const Interaction& interaction, std::size_t batch);
  [[nodiscard]] bool hasStep(const StepClock& clock) const;
  void upload(const StepInputs& inputs, std::size_t steps);

  std::size_t pieces_ = 0, colliderCount_ = 0, pathCount_ = 0;
  bool changes_ = false;  // from step to step
  bool grabs_ = false, holds_ = false;
  StepClock batchStart_;        // of the first step that is uploaded,
  std::size_t batchSteps_ = 0;  // and how many are; 0: none
  std::size_t step_ = 0;        // the one that is bound, in the batch

  StepParameters<float> evaluated_;
  std::vector<StepSlot> stagedSteps_;
  std::vector<InteractionSlot> stagedInteractions_;
  std::vector<ColliderParams<float>> stagedColliders_;
  std::vector<PinMotionParams<float>> stagedPinMotions_;
  gl::Buffer<StepSlot> steps_;  // a batch of steps, each with all grids
  gl::Buffer<InteractionSlot> interactions_;
  gl::Buffer<ColliderParams<float>> colliders_;    // each step with all colliders
  gl::Buffer<PinMotionParams<float>> pinMotions_;  // each step with all paths
  gl::BufferTexture colliderTexture_, pinMotionTexture_;

  gl::Buffer<Particle4> pinStarts_;  // xyz and the number of the path + 1; one unused element without paths
  gl::BufferTexture pinStartTexture_;
  std::vector<std::uint32_t> pinNumbers_;
  std::shared_ptr<const std::vector<GrabSpring::Point>> grabbedPoints_;
  gl::Buffer<GrabSpring::Point> grabbed_;
  gl::BufferTexture grabbedTexture_;
  std::shared_ptr<const std::vector<Particle4>> externalForces_;
  gl::Buffer<Particle4> external_;
  gl::BufferTexture externalTexture_;
};

}  // namespace clothsim
