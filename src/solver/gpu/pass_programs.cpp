#include "solver/gpu/pass_programs.h"

namespace clothsim {

PassFeatures featuresOf(const Scene& scene, const Grid& grid) {
  PassFeatures features;
  features.wind = scene.wind.has_value();
  features.airResistance = scene.airResistance > 0;
  features.colliders = !scene.colliders.empty();
  for (const Collider& collider : scene.colliders) features.movingColliders |= moves(collider);
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
          {"HAS_COLLIDERS", std::to_string(features.colliders)},
          {"HAS_MOVING_COLLIDERS", std::to_string(features.movingColliders)},
          {"HAS_REST_LENGTH_TABLE", std::to_string(features.restLengthTable)},
          {"ENABLED_SLOTS", std::to_string(features.enabledSlots) + "u"}};
}

PassPrograms::PassPrograms(const PassFeatures& features) {
  const gl::Defines defines = definesFor(features);
  if (features.fused) {
    step = gl::Program::makeCompute("sim/step.comp", defines);
  } else {
    forces = gl::Program::makeCompute("sim/forces.comp", defines);
    integrate = gl::Program::makeCompute("sim/integrate.comp", defines);
    collide = gl::Program::makeCompute("sim/collide.comp", defines);
  }
  limit = gl::Program::makeCompute("sim/limit.comp", defines);
  kick = gl::Program::makeCompute("sim/kick.comp", defines);
}

}  // namespace clothsim
