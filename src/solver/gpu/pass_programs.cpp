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
    features.colliderTypes |= 1u << collider.index();
    features.movingColliders |= moves(collider);
  }
  features.coulombFriction = !scene.colliders.empty() && scene.solver.frictionLaw == FrictionLaw::coulomb;
  features.contactPlanes = scene.solver.integrator == Integrator::implicit && !scene.colliders.empty();
  features.movingPins = !scene.cloths[gridIndex].pinMotion.empty();
  features.restLengthTable = grid.hasRestLengthTable;
  features.material = grid.hasMaterial;
  features.mesh = grid.isMesh;
  features.limitSprings = scene.solver.integrator == Integrator::implicit && scene.solver.strainLimit;
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
          {"HAS_MATERIAL", std::to_string(features.material)},
          {"HAS_MESH", std::to_string(features.mesh)},
          {"HAS_LIMIT_SPRINGS", std::to_string(features.limitSprings)},
          {"HAS_CONTACT_PLANES", std::to_string(features.contactPlanes)},
          {"SUM_KIND", std::to_string(features.sumKind)},
          {"HAS_HOLD", std::to_string(features.hold)},
          {"HAS_JET", std::to_string(features.jet)},
          {"HAS_CUTS", std::to_string(features.cuts)},
          {"COLLIDES_IN_STEP", std::to_string(features.collidesInStep)},
          {"ENABLED_SLOTS", std::to_string(features.enabledSlots) + "u"}};
}

namespace {

// The features that a pass looks at, all others at their defaults.
PassFeatures featuresOfPass(const std::string& pass, const PassFeatures& all) {
  PassFeatures features;
  features.groupColumns = all.groupColumns;
  features.groupRows = all.groupRows;
  if (pass == "step" || pass == "forces" || pass == "kick") {
    features.wind = all.wind;
    features.airResistance = all.airResistance;
    features.restLengthTable = all.restLengthTable;
    features.enabledSlots = all.enabledSlots;
    features.material = all.material;
    features.mesh = all.mesh;
    features.jet = all.jet;
    features.cuts = all.cuts;
  }
  if (pass == "implicit/begin") {
    features.mesh = all.mesh;
    features.wind = all.wind;
    features.airResistance = all.airResistance;
    features.jet = all.jet;
    features.cuts = all.cuts;
  }
  if (pass == "implicit/linearize" || pass == "implicit/multiply" || pass == "implicit/try_lengths") {
    features.contactPlanes = all.contactPlanes;
    features.mesh = all.mesh;
    features.wind = all.wind;
    features.restLengthTable = all.restLengthTable;
    features.enabledSlots = all.enabledSlots;
    features.material = all.material;
    features.cuts = all.cuts;
  }
  if (pass == "implicit/coarsen" || pass == "implicit/restrict" || pass == "implicit/prolong")
    features.cuts = all.cuts;
  features.limitSprings =
      all.limitSprings && (features.enabledSlots != 0 || features.mesh);  // of passes that look at springs
  if (pass.starts_with("implicit/sum")) features.sumKind = all.sumKind;
  if (pass == "implicit/end") {
    features.movingPins = all.movingPins;
    features.contactPlanes = all.contactPlanes;
  }
  if (pass == "step" || pass == "integrate" || pass == "implicit/begin") {
    features.movingPins = all.movingPins;
    features.hold = all.hold;
  }
  features.collidesInStep = pass == "step" && all.collidesInStep;
  if (features.collidesInStep || pass == "collide" || pass == "implicit/find_planes") {
    features.colliderTypes = all.colliderTypes;
    features.movingColliders = all.movingColliders;
    features.coulombFriction = all.coulombFriction;
  }
  if (pass == "limit") {
    features.mesh = all.mesh;
    features.restLengthTable = all.restLengthTable;
    features.cuts = all.cuts;
  }
  return features;
}

}  // namespace

const gl::Program* PassLibrary::find(const std::string& pass, const PassFeatures& features) {
  const std::pair key{pass, featuresOfPass(pass, features)};
  auto found = programs_.find(key);
  if (found == programs_.end())
    found = programs_.emplace(key, gl::Program::makeCompute("sim/" + pass + ".comp", definesFor(key.second)))
                .first;
  return &found->second;
}

PassPrograms PassLibrary::programsFor(const PassFeatures& features) {
  PassPrograms programs;
  if (features.fused) {
    programs.step = find("step", features);
  } else {
    programs.forces = find("forces", features);
    programs.integrate = find("integrate", features);
  }
  if (!features.fused || !features.collidesInStep || features.collidesAgain)
    programs.collide = find("collide", features);
  programs.limit = find("limit", features);
  programs.watchLimit = find("watch_limit", features);
  programs.kick = find("kick", features);
  programs.start = find("start", features);
  return programs;
}

}  // namespace clothsim
