// What a step depends on besides the particles: the same for both backends.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "core/shared.h"
#include "scene/scene.h"
#include "solver/interaction.h"
#include "solver/pin_paths.h"
#include "solver/step_clock.h"
#include "solver/step_params.h"

namespace clothsim {

struct StepInputs {
  const Cloth* cloth = nullptr;
  Shared<Scene> scene;
  StepClock clock;
  Integrator velocityMeaning = Integrator::verlet;  // what the velocities of the state mean
  Interaction interaction;
  Cuts cuts;
  std::vector<std::uint32_t> cutMasks;  // makeCutMasks(); empty: none
  std::vector<std::uint32_t> offPath;   // State::offPath
  PinPaths pinPaths;
  ColliderSet colliders;
};

// The inputs of one step, evaluated on the host.
template <class Real>
struct StepParameters {
  std::vector<StepParams<Real>> pieces;
  std::vector<ColliderParams<Real>> colliders;
  std::vector<PinMotionParams<Real>> pinMotions;
  InteractionParams<Real> interaction;
};
// Of the step that comes after `ahead` others.
template <class Real>
void evaluate(const StepInputs& inputs, std::uint64_t ahead, StepParameters<Real>& parameters);

}  // namespace clothsim
