#include "solver/trouble.h"

#include <cstdio>

namespace clothsim {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string placeOnTheCloth(std::uint32_t particle, const Cloth& cloth) {
  const std::size_t index = cloth.gridOf(particle);
  const Grid& grid = cloth.grids()[index];
  if (grid.isMesh)
    return "cloth " + std::to_string(index) + ", vertex " + std::to_string(particle - grid.firstParticle);
  const std::uint32_t onGrid = particle - grid.firstParticle,
                      columns = static_cast<std::uint32_t>(grid.columns);
  return "cloth " + std::to_string(index) + ", column " + std::to_string(onGrid % columns) + ", row " +
         std::to_string(onGrid / columns);
}

std::string what(const Trouble& trouble, const Scene& scene) {
  switch (trouble.reason) {
    case TroubleReason::nonFinite:
      return "is no longer a finite number";
    case TroubleReason::runawaySpeed:
      return "runs away: it is faster than solver.max_speed, " + number(scene.solver.maxSpeed) + " m/s";
    case TroubleReason::runawayStrain:
      return "runs away: a spring at it is stretched by more than solver.max_strain, " +
             number(scene.solver.maxStrain) + " times its rest length";
  }
  return "";
}

}  // namespace

std::string nameOf(Pass pass) {
  switch (pass) {
    case Pass::start:
      return "start";
    case Pass::kick:
      return "kick";
    case Pass::forces:
      return "forces";
    case Pass::integrate:
      return "integrate";
    case Pass::collide:
      return "collide";
    case Pass::earlyLimit:
    case Pass::limit:
      return "limit";
  }
  return "";
}

WatchRow soundWatchRow() {
  WatchRow row;
  row.fill(NO_TROUBLE);
  return row;
}

std::optional<Trouble> firstTrouble(const WatchRow& row, std::uint64_t step) {
  for (std::uint32_t pass = 0; pass < PASSES; ++pass)
    if (row[pass] != NO_TROUBLE)
      return Trouble{static_cast<TroubleReason>(row[pass] % 4), static_cast<Pass>(pass), step, row[pass] / 4};
  return std::nullopt;
}

std::string troubleText(const Trouble& trouble, const Cloth& cloth, const Scene& scene) {
  const auto stepsPerFrame = static_cast<std::uint64_t>(scene.solver.simulationSteps);
  return "in step " + std::to_string(trouble.step) + " (frame " +
         std::to_string((trouble.step + stepsPerFrame - 1) / stepsPerFrame) + "), pass " +
         nameOf(trouble.pass) + ", particle " + std::to_string(trouble.particle) + " (" +
         placeOnTheCloth(trouble.particle, cloth) + ") " + what(trouble, scene);
}

std::string troubleAdvice(const Trouble& trouble, const Scene& scene) {
  if (trouble.pass == Pass::start)
    return "The state that the step began with was wrong already: begin with another one.";
  std::string advice = "The explicit step of " + number(stepLength(scene.solver)) +
                       " s is most likely too long for these springs: raise solver.simulation_steps (now " +
                       std::to_string(scene.solver.simulationSteps) + "), or lower the stiffness.";
  if (trouble.reason == TroubleReason::runawaySpeed) advice += " If it is meant, raise solver.max_speed.";
  if (trouble.reason == TroubleReason::runawayStrain) advice += " If it is meant, raise solver.max_strain.";
  return advice;
}

}  // namespace clothsim
