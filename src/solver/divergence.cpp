#include "solver/divergence.h"

#include <algorithm>

#include "cloth/material.h"
#include "cloth/pins.h"
#include "core/formatted.h"
#include "scene/budget.h"

namespace clothsim {
namespace {

std::string number(double value) { return formatted("%g", value); }

std::string placeOnTheCloth(std::uint32_t particle, const Cloth& cloth, const Scene& scene) {
  const std::size_t index = cloth.pieceOf(particle);
  const Piece& piece = cloth.pieces()[index];
  if (piece.isMesh)
    return "cloth " + std::to_string(index) + ", vertex " +
           std::to_string(vertexPinOf(scene.cloths[index], particle - piece.firstParticle).vertex);
  const std::uint32_t onGrid = particle - piece.firstParticle,
                      columns = static_cast<std::uint32_t>(piece.columns);
  return "cloth " + std::to_string(index) + ", column " + std::to_string(onGrid % columns) + ", row " +
         std::to_string(onGrid / columns);
}

std::string what(const Divergence& divergence, const Scene& scene) {
  switch (divergence.reason) {
    case DivergenceReason::nonFinite:
      return "is no longer a finite number";
    case DivergenceReason::runawaySpeed:
      return "exceeded solver.max_speed, " + number(scene.solver.maxSpeed) + " m/s";
    case DivergenceReason::runawayStrain:
      return "exceeded solver.max_strain: a spring at it is stretched by more than " +
             number(scene.solver.maxStrain) + " times its rest length";
  }
  return "";
}

// By PASS_... of shared/step_params.h, in the order of a step. Self-collision is none of them, since it moves
// particles by no more than their distance.
constexpr std::array<Pass, PASSES> watchedPasses{
    Pass::checkStart, Pass::kick, Pass::forces, Pass::integrate, Pass::limit, Pass::collide, Pass::limit};

}  // namespace

WatchRow soundWatchRow() {
  WatchRow row;
  row.fill(NO_DIVERGENCE);
  return row;
}

std::optional<Divergence> firstDivergence(const WatchRow& row, std::uint64_t step) {
  for (std::uint32_t pass = 0; pass < PASSES; ++pass)
    if (row[pass] != NO_DIVERGENCE)
      return Divergence{static_cast<DivergenceReason>(row[pass] % 4), watchedPasses[pass], step,
                        row[pass] / 4};
  return std::nullopt;
}

std::string divergenceText(const Divergence& divergence, const Cloth& cloth, const Scene& scene,
                           std::optional<int> frame) {
  const auto stepsPerFrame = static_cast<std::uint64_t>(scene.solver.simulationSteps);
  const std::uint64_t counted = (divergence.step + stepsPerFrame - 1) / stepsPerFrame;
  return "in step " + std::to_string(divergence.step) + " (frame " +
         (frame ? std::to_string(*frame) : std::to_string(counted)) + "), pass " + nameOf(divergence.pass) +
         ", particle " + std::to_string(divergence.particle) + " (" +
         placeOnTheCloth(divergence.particle, cloth, scene) + ") " + what(divergence, scene);
}

namespace {

// An explicit integrator with this many times the steps takes longer than the implicit one.
constexpr int MOST_TIMES_THE_STEPS = 20;
constexpr int SHORTER_IMPLICIT_STEPS = 4;

std::string stepsSetting(int steps) { return "solver.simulation_steps=" + std::to_string(steps); }

Remedy forImplicitSteps(const Scene& scene) {
  const int steps = std::min(scene.solver.simulationSteps * SHORTER_IMPLICIT_STEPS, mostSteps);
  return {"Implicit steps are stable, but in one of " + number(stepLength(scene.solver)) +
              " s fast pins, colliders or grabs outrun the cloth. Take shorter ones: --set " +
              stepsSetting(steps) + ".",
          {stepsSetting(steps)}};
}

Remedy forExplicitSteps(const Scene& scene) {
  const double h = stepLength(scene.solver), stable = stableStep(scene);
  const std::string implicit = "solver.integrator=implicit";
  if (h <= stable * (1 + 1e-9))
    return {
        "The springs are not the cause: steps up to " + number(stable) +
            " s are guaranteed stable, and these are of " + number(h) +
            " s. Pins, colliders, air, shrinking cloth or grabs may be too fast for explicit steps: --set " +
            implicit + ".",
        {implicit}};
  const int steps = stableSteps(scene);
  const bool stableStepsExist = 1 / (scene.solver.framesPerSec * steps) <= stable * (1 + 1e-9);
  std::string text = "Steps of " + number(h) + " s are too long for these springs; steps up to " +
                     number(stable) + " s are guaranteed stable: ";
  if (stableStepsExist)
    text +=
        "--set " + stepsSetting(steps) + " (now " + std::to_string(scene.solver.simulationSteps) + "), or ";
  const bool keepsIntegrator = stableStepsExist && !usesMaterial(scene) &&
                               steps <= MOST_TIMES_THE_STEPS * scene.solver.simulationSteps;
  return {text + "--set " + implicit + ".", {keepsIntegrator ? stepsSetting(steps) : implicit}};
}

}  // namespace

Remedy remedyFor(const Divergence& divergence, const Scene& scene) {
  if (divergence.pass == Pass::checkStart)
    return {"The state that the step began with was wrong already: begin with another one.", {}};
  Remedy remedy = isImplicit(scene.solver.integrator) ? forImplicitSteps(scene) : forExplicitSteps(scene);
  if (divergence.reason == DivergenceReason::runawaySpeed)
    remedy.text += " If it is meant, raise solver.max_speed.";
  if (divergence.reason == DivergenceReason::runawayStrain)
    remedy.text += " If it is meant, raise solver.max_strain.";
  return remedy;
}

}  // namespace clothsim
