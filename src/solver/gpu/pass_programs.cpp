#include "solver/gpu/pass_programs.h"

#include "solver/step_params.h"

namespace clothsim {

PassFeatures featuresOf(const Scene& scene, const Cloth& cloth, std::size_t gridIndex, const Hand& hand,
                        const Cuts& cuts) {
  const Grid& grid = cloth.grids()[gridIndex];
  PassFeatures features;
  features.wind = scene.wind.has_value() || hand.jet.has_value();
  features.jet = hand.jet.has_value();
  features.hold = hand.hold && hand.hold->grid == gridIndex;
  features.cuts = !cuts.empty();
  features.airResistance = scene.airResistance > 0;
  for (const Collider& collider : scene.colliders) {
    features.colliderTypes |= 1u << colliderType(collider);
    features.movingColliders |= moves(collider);
  }
  features.coulombFriction = !scene.colliders.empty() && scene.solver.frictionLaw == FrictionLaw::coulomb;
  features.movingPins = !scene.cloths[gridIndex].pinMotion.empty();
  features.restLengthTable = grid.hasRestLengthTable;
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
    if (grid.slotEnabled[slot]) features.enabledSlots |= 1u << slot;
  return features;
}

gl::Defines definesFor(const PassFeatures& features) {
  return {{"WORK_GROUP_COLUMNS", std::to_string(features.groupColumns)},
          {"WORK_GROUP_ROWS", std::to_string(features.groupRows)},
          {"HAS_WIND", std::to_string(features.wind)},
          {"HAS_AIR_RESISTANCE", std::to_string(features.airResistance)},
          {"COLLIDER_TYPES", std::to_string(features.colliderTypes) + "u"},
          {"HAS_COULOMB_FRICTION", std::to_string(features.coulombFriction)},
          {"HAS_MOVING_COLLIDERS", std::to_string(features.movingColliders)},
          {"HAS_MOVING_PINS", std::to_string(features.movingPins)},
          {"HAS_REST_LENGTH_TABLE", std::to_string(features.restLengthTable)},
          {"HAS_HOLD", std::to_string(features.hold)},
          {"HAS_JET", std::to_string(features.jet)},
          {"HAS_CUTS", std::to_string(features.cuts)},
          {"COLLIDES_IN_STEP", std::to_string(features.collidesInStep)},
          {"ENABLED_SLOTS", std::to_string(features.enabledSlots) + "u"}};
}

PassPrograms::PassPrograms(const PassFeatures& features) {
  const gl::Defines defines = definesFor(features);
  if (features.fused) {
    step = gl::Program::makeCompute("sim/step.comp", defines);
  } else {
    forces = gl::Program::makeCompute("sim/forces.comp", defines);
    integrate = gl::Program::makeCompute("sim/integrate.comp", defines);
  }
  if (!features.fused || !features.collidesInStep || features.collidesAgain)
    collide = gl::Program::makeCompute("sim/collide.comp", defines);
  limit = gl::Program::makeCompute("sim/limit.comp", defines);
  watchLimit = gl::Program::makeCompute("sim/watch_limit.comp", defines);
  kick = gl::Program::makeCompute("sim/kick.comp", defines);
  start = gl::Program::makeCompute("sim/start.comp", defines);
}

}  // namespace clothsim
