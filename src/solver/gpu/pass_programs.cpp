#include "solver/gpu/pass_programs.h"

#include <algorithm>
#include <cassert>

#include "shared/implicit.h"
#include "solver/step_params.h"

namespace clothsim {

PassFeatures featuresOf(const Scene& scene, const Cloth& cloth, std::size_t pieceIndex,
                        const Interaction& interaction, const Cuts& cuts) {
  const Piece& piece = cloth.pieces()[pieceIndex];
  PassFeatures features;
  features.wind = scene.wind.has_value() || interaction.jet.has_value();
  features.jet = interaction.jet.has_value();
  features.grab = interaction.grab && interaction.grab->piece == pieceIndex;
  features.cuts = !cuts.empty();
  features.particleForces = particleForcesOf(scene);
  for (const Collider& collider : scene.colliders) {
    features.colliderTypes |= 1u << collider.index();
    features.movingColliders |= moves(collider);
  }
  features.coulombFriction = !scene.colliders.empty() && scene.solver.frictionLaw == FrictionLaw::coulomb;
  features.contactPlanes = isImplicit(scene.solver.integrator) && !scene.colliders.empty();
  features.history = scene.solver.integrator == Integrator::bdf2;
  features.movingPins = !scene.cloths[pieceIndex].pinMotion.empty();
  features.restLengthTable = piece.hasRestLengthTable;
  features.material = piece.hasMaterial;
  features.mesh = piece.isMesh;
  features.limitSprings = isImplicit(scene.solver.integrator) && scene.solver.strainLimit;
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
    if (piece.slotEnabled[slot]) features.enabledSlots |= 1u << slot;
  return features;
}

PassFeatures restricted(const PassFeatures& all, Features to) {
  PassFeatures features;
  const auto take = [&](Feature feature, auto... members) {
    if (to.contains(feature)) ((features.*members = all.*members), ...);
  };
  features.groupColumns = all.groupColumns;
  features.groupRows = all.groupRows;
  take(Feature::springs, &PassFeatures::enabledSlots, &PassFeatures::material, &PassFeatures::limitSprings);
  take(Feature::restLengths, &PassFeatures::restLengthTable);
  take(Feature::meshes, &PassFeatures::mesh);
  take(Feature::wind, &PassFeatures::wind);
  take(Feature::particleForces, &PassFeatures::particleForces);
  take(Feature::jets, &PassFeatures::jet);
  take(Feature::grabs, &PassFeatures::grab);
  take(Feature::cuts, &PassFeatures::cuts);
  take(Feature::movingPins, &PassFeatures::movingPins);
  take(Feature::colliders, &PassFeatures::colliderTypes, &PassFeatures::movingColliders,
       &PassFeatures::coulombFriction);
  take(Feature::planes, &PassFeatures::contactPlanes);
  take(Feature::history, &PassFeatures::history);
  return features;
}

gl::Defines definesFor(const PassFeatures& features) {
  return {{"WORK_GROUP_COLUMNS", std::to_string(features.groupColumns)},
          {"WORK_GROUP_ROWS", std::to_string(features.groupRows)},
          {"HAS_WIND", std::to_string(features.wind)},
          {"ACTIVE_FORCES", std::to_string(features.particleForces) + "u"},
          {"COLLIDER_TYPES", std::to_string(features.colliderTypes) + "u"},
          {"HAS_COULOMB_FRICTION", std::to_string(features.coulombFriction)},
          {"HAS_MOVING_COLLIDERS", std::to_string(features.movingColliders)},
          {"HAS_MOVING_PINS", std::to_string(features.movingPins)},
          {"HAS_REST_LENGTH_TABLE", std::to_string(features.restLengthTable)},
          {"HAS_MATERIAL", std::to_string(features.material)},
          {"HAS_MESH", std::to_string(features.mesh)},
          {"HAS_LIMIT_SPRINGS", std::to_string(features.limitSprings)},
          {"HAS_CONTACT_PLANES", std::to_string(features.contactPlanes)},
          {"HAS_HISTORY", std::to_string(features.history)},
          {"HAS_GRAB", std::to_string(features.grab)},
          {"HAS_JET", std::to_string(features.jet)},
          {"HAS_CUTS", std::to_string(features.cuts)},
          {"GATE", std::to_string(features.gate)},
          {"ENABLED_SLOTS", std::to_string(features.enabledSlots) + "u"}};
}

const std::vector<Kernel>& kernels() {
  const auto sum = [](Pass pass, int kind) {
    return Kernel{
        {pass}, {"implicit/sum_blocks", "implicit/sum_totals"}, {{"SUM_KIND", std::to_string(kind)}}};
  };
  static const std::vector<Kernel> all{
      {{Pass::forces, Pass::integrate, Pass::collide}, {"step"}, {{"COLLIDES_IN_STEP", "1"}}},
      {{Pass::forces, Pass::integrate}, {"step"}, {{"COLLIDES_IN_STEP", "0"}}},
      {{Pass::forces, Pass::kick}, {"kick"}, {}},
      {{Pass::checkStart}, {"start"}, {}},
      {{Pass::forces}, {"forces"}, {}},
      {{Pass::integrate}, {"integrate"}, {}},
      {{Pass::begin}, {"implicit/begin"}, {}},
      {{Pass::findPlanes}, {"implicit/find_planes"}, {{"PREDICTS", "0"}}},
      {{Pass::predictPlanes}, {"implicit/find_planes"}, {{"PREDICTS", "1"}}},
      {{Pass::elasticForces}, {"forces"}, {}},
      {{Pass::linearize}, {"implicit/linearize"}, {}},
      {{Pass::findCenters}, {"implicit/find_centers"}, {}},
      {{Pass::coarsen}, {"implicit/coarsen_elements", "implicit/coarsen"}, {}},
      {{Pass::invertDense}, {"implicit/invert_dense"}, {}},
      {{Pass::restrict}, {"implicit/restrict"}, {}},
      {{Pass::solveCoarsest}, {"implicit/solve_coarsest"}, {}},
      {{Pass::prolong}, {"implicit/prolong"}, {}},
      sum(Pass::sumFirstResidual, SUM_FIRST),
      {{Pass::updateDirection}, {"implicit/update_direction"}, {}},
      {{Pass::multiply}, {"implicit/multiply"}, {}},
      sum(Pass::sumCurvature, SUM_STEP),
      {{Pass::updateSolution}, {"implicit/update_solution"}, {}},
      sum(Pass::sumNextResidual, SUM_NEXT),
      {{Pass::tryLengths}, {"implicit/try_lengths"}, {}},
      sum(Pass::sumEnergies, SUM_LENGTH),
      {{Pass::accept}, {"implicit/accept"}, {}},
      sum(Pass::measureUpdate, SUM_UPDATE),
      {{Pass::end}, {"implicit/end"}, {}},
      {{Pass::remember}, {"implicit/remember"}, {}},
      {{Pass::countStep}, {"implicit/count_step"}, {}},
      {{Pass::collide}, {"collide"}, {}},
      {{Pass::limit}, {"limit"}, {}},
      {{Pass::watchLimit}, {"watch_limit"}, {}},
  };
  return all;
}

std::size_t kernelFor(std::span<const PassCall> passes, bool fused) {
  const auto begins = [&](const Kernel& kernel) {
    const std::vector<Pass>& own = kernel.passes;
    if (own.size() > passes.size() || (!fused && own.size() > 1 && own.back() != Pass::kick)) return false;
    return std::equal(own.begin(), own.end(), passes.begin(),
                      [](Pass pass, const PassCall& call) { return pass == call.pass; });
  };
  const auto found = std::find_if(kernels().begin(), kernels().end(), begins);
  assert(found != kernels().end() && "every pass has a kernel, and the kick one with the forces");
  return static_cast<std::size_t>(found - kernels().begin());
}

std::vector<const gl::Program*> PassLibrary::find(const Kernel& kernel, const PassFeatures& features) {
  Features seen;
  for (const Pass pass : kernel.passes) seen = seen | traitsOf(pass).features;
  PassFeatures own = restricted(features, seen);
  own.gate = static_cast<int>(traitsOf(kernel.passes.front()).gate);
  gl::Defines defines = definesFor(own);
  defines.insert(defines.end(), kernel.defines.begin(), kernel.defines.end());
  std::vector<const gl::Program*> programs;
  for (const std::string& shader : kernel.shaders) {
    std::string name = shader;
    for (const auto& [macro, value] : kernel.defines) name += " " + macro + "=" + value;
    auto found = programs_.find({name, own});
    if (found == programs_.end())
      found = programs_
                  .emplace(std::pair{name, own}, gl::Program::makeCompute("sim/" + shader + ".comp", defines))
                  .first;
    programs.push_back(&found->second);
  }
  return programs;
}

}  // namespace clothsim
