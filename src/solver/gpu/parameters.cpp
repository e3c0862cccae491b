#include "solver/gpu/parameters.h"

#include <algorithm>

namespace clothsim {
namespace {

// How many steps' parameters are uploaded at once when they differ.
constexpr std::size_t BATCH_STEPS = 64;

// Grows; does not shrink.
template <class Element>
bool reserve(gl::Buffer<Element>& buffer, std::vector<Element>& staged, const char* label,
             std::size_t count) {
  if (buffer.name() != 0 && buffer.size() >= count) return false;
  staged.resize(count);
  buffer = gl::Buffer<Element>(label, count);
  return true;
}

}  // namespace

void GpuParameters::prepare(const StepInputs& inputs) {
  const Interaction& interaction = inputs.interaction;
  holds_ = interaction.grab.has_value();
  grabs_ = holds_ || interaction.jet.has_value();
  changes_ = grabs_ || dependsOnTime(*inputs.scene);
  pieces_ = inputs.cloth->pieces().size();
  colliderCount_ = inputs.scene->colliders.size();
  pathCount_ = inputs.pinPaths.paths.size();
  const std::size_t batch = changes_ ? BATCH_STEPS : 1;
  reserve(steps_, stagedSteps_, "step parameters", batch * pieces_);
  if (reserve(colliders_, stagedColliders_, "colliders", batch * colliderCount_))
    colliderTexture_ = gl::BufferTexture("colliders", colliders_.name(), GL_RGBA32F);
  preparePins(inputs.pinPaths, *inputs.cloth, batch);
  if (grabs_) prepareInteraction(interaction, batch);
  prepareExternalForces(interaction);
  batchSteps_ = 0;
}

void GpuParameters::preparePins(const PinPaths& paths, const Cloth& cloth, std::size_t batch) {
  if (reserve(pinMotions_, stagedPinMotions_, "pin motions", batch * paths.paths.size()))
    pinMotionTexture_ = gl::BufferTexture("pin motions", pinMotions_.name(), GL_RGBA32F);
  if (pinStarts_.name() != 0 && pinNumbers_ == paths.numbers) return;
  pinNumbers_ = paths.numbers;
  std::vector<Particle4> starts(pinNumbers_.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto x = startPosition<float>(cloth, i);
    starts[i] = {x.x, x.y, x.z, static_cast<float>(pinNumbers_[i])};
  }
  pinStarts_ = gl::Buffer<Particle4>("start positions of pins", std::span<const Particle4>(starts));
  pinStartTexture_ = gl::BufferTexture("start positions of pins", pinStarts_.name(), GL_RGBA32F);
}

void GpuParameters::prepareInteraction(const Interaction& interaction, std::size_t batch) {
  reserve(interactions_, stagedInteractions_, "interaction parameters", batch);
  if (!interaction.grab || interaction.grab->points == grabbedPoints_) return;
  grabbedPoints_ = interaction.grab->points;
  grabbed_ =
      gl::Buffer<GrabSpring::Point>("grabbed points", std::span<const GrabSpring::Point>(*grabbedPoints_));
  grabbedTexture_ = gl::BufferTexture("grabbed points", grabbed_.name(), GL_RGBA32F);
}

void GpuParameters::prepareExternalForces(const Interaction& interaction) {
  if (interaction.externalForces == externalForces_) return;
  externalForces_ = interaction.externalForces;
  if (!externalForces_) return;
  external_ = gl::Buffer<Particle4>("external forces", std::span<const Particle4>(*externalForces_));
  externalTexture_ = gl::BufferTexture("external forces", external_.name(), GL_RGBA32F);
}

bool GpuParameters::hasStep(const StepClock& clock) const {
  if (batchSteps_ == 0 || !changes_) return batchSteps_ != 0;
  StepClock first = clock;
  first.step = batchStart_.step;
  return first == batchStart_ && clock.step >= first.step && clock.step - first.step < batchSteps_;
}

void GpuParameters::upload(const StepInputs& inputs, std::size_t steps) {
  for (std::size_t k = 0; k < steps; ++k) {
    evaluate(inputs, k, evaluated_);
    for (std::size_t piece = 0; piece < pieces_; ++piece) {
      StepParams<float>& params = stagedSteps_[k * pieces_ + piece].params;
      params = evaluated_.pieces[piece];
      params.firstCollider = static_cast<std::uint32_t>(k * colliderCount_);
      params.firstPinMotion = static_cast<std::uint32_t>(k * pathCount_);
    }
    std::copy(evaluated_.colliders.begin(), evaluated_.colliders.end(),
              stagedColliders_.begin() + static_cast<std::ptrdiff_t>(k * colliderCount_));
    std::copy(evaluated_.pinMotions.begin(), evaluated_.pinMotions.end(),
              stagedPinMotions_.begin() + static_cast<std::ptrdiff_t>(k * pathCount_));
    if (grabs_) stagedInteractions_[k].params = evaluated_.interaction;
  }
  steps_.upload({stagedSteps_.data(), steps * pieces_});
  colliders_.upload({stagedColliders_.data(), steps * colliderCount_});
  if (pathCount_ > 0) pinMotions_.upload({stagedPinMotions_.data(), steps * pathCount_});
  if (grabs_) interactions_.upload({stagedInteractions_.data(), steps});
  batchStart_ = inputs.clock;
  batchSteps_ = steps;
}

void GpuParameters::bind(const StepInputs& inputs, int steps) {
  if (!hasStep(inputs.clock))
    upload(inputs, changes_ ? std::min(BATCH_STEPS, static_cast<std::size_t>(std::max(steps, 1))) : 1);
  step_ = changes_ ? static_cast<std::size_t>(inputs.clock.step - batchStart_.step) : 0;
  colliderTexture_.bind(COLLIDERS_UNIT);
  pinStartTexture_.bind(PIN_STARTS_UNIT);
  pinMotionTexture_.bind(PIN_MOTIONS_UNIT);
  if (grabs_) interactions_.bindUniformRange(INTERACTION_PARAMS_BINDING, step_, 1);
  if (holds_) grabbedTexture_.bind(GRABBED_UNIT);
  if (externalForces_) externalTexture_.bind(EXTERNAL_FORCES_UNIT);
}

void GpuParameters::bindPiece(std::size_t piece) const {
  steps_.bindUniformRange(STEP_PARAMS_BINDING, step_ * pieces_ + piece, 1);
}

}  // namespace clothsim
