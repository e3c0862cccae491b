#include "solver/step_inputs.h"

namespace clothsim {

template <class Real>
void evaluate(const StepInputs& inputs, std::uint64_t ahead, StepParameters<Real>& parameters) {
  const Scene& scene = *inputs.scene;
  const double begin = inputs.clock.timeAfter(ahead), end = inputs.clock.timeAfter(ahead + 1);
  parameters.pieces.resize(inputs.cloth->pieces().size());
  for (std::size_t piece = 0; piece < parameters.pieces.size(); ++piece) {
    StepParams<Real>& params = parameters.pieces[piece];
    params = makeStepParams<Real>(scene, *inputs.cloth, piece, begin);
    params.kickTime = velocityConversionTime<Real>(scene);
    addJet(inputs.interaction, scene, params);
  }
  parameters.colliders.resize(inputs.colliders.size());
  for (std::size_t i = 0; i < parameters.colliders.size(); ++i)
    parameters.colliders[i] = inputs.colliders.params<Real>(i, begin, end);
  parameters.pinMotions.resize(inputs.pinPaths.paths.size());
  for (std::size_t i = 0; i < parameters.pinMotions.size(); ++i)
    parameters.pinMotions[i] =
        makePinMotionParams<Real>(inputs.pinPaths.paths[i], end, stepLength(scene.solver));
  parameters.interaction = makeInteractionParams<Real>(inputs.interaction, scene, inputs.clock.step + ahead);
}

template void evaluate(const StepInputs&, std::uint64_t, StepParameters<float>&);
template void evaluate(const StepInputs&, std::uint64_t, StepParameters<double>&);

}  // namespace clothsim
