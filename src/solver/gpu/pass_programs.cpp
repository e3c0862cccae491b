#include "solver/gpu/pass_programs.h"

#include <algorithm>
#include <cassert>

#include "shared/implicit.h"
#include "shared/shapes.h"
#include "solver/step_params.h"
#include "solver/surface.h"
#include "solver/tearing.h"

namespace clothsim {

PassFeatures featuresOf(const Scene& scene, const Cloth& cloth, std::size_t pieceIndex,
                        const Interaction& interaction, const Cuts& cuts) {
  const Piece& piece = cloth.pieces()[pieceIndex];
  PassFeatures features;
  features.wind = hasAir(scene) || interaction.jet.has_value();
  features.jet = interaction.jet.has_value();
  features.grab = interaction.grab && interaction.grab->piece == pieceIndex;
  features.externalForces = interaction.externalForces != nullptr;
  features.cuts = mayBeCut(scene, cuts);  // no kernel is compiled in the frame in which cloth tears
  features.particleForces = particleForcesOf(scene);
  for (const Collider& collider : scene.colliders) {
    features.colliderTypes |= 1u << collider.index();
    if (deforms(collider)) features.colliderTypes |= 1u << COLLIDER_DEFORMS;
    features.movingColliders |= moves(collider);
  }
  features.coulombFriction = !scene.colliders.empty() && scene.solver.frictionLaw == FrictionLaw::coulomb;
  features.contactPlanes = isImplicit(scene.solver.integrator) && !scene.colliders.empty();
  features.surface = isImplicit(scene.solver.integrator) && hasSurface(scene, cloth);
  features.smallColliders = hasSmallColliders(scene, cloth);
  features.history = scene.solver.integrator == Integrator::bdf2;
  features.movingPins = !scene.cloths[pieceIndex].pinMotion.empty();
  features.restLengthTable = piece.hasRestLengthTable;
  features.material = piece.hasMaterial;
  features.mesh = piece.isMesh;
  features.seams = !cloth.seams().empty();
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
  features.storageLoads = all.storageLoads;
  take(Feature::springs, &PassFeatures::enabledSlots, &PassFeatures::material, &PassFeatures::limitSprings);
  take(Feature::restLengths, &PassFeatures::restLengthTable);
  take(Feature::meshes, &PassFeatures::mesh);
  take(Feature::seams, &PassFeatures::seams);
  take(Feature::wind, &PassFeatures::wind);
  take(Feature::particleForces, &PassFeatures::particleForces);
  take(Feature::jets, &PassFeatures::jet);
  take(Feature::grabs, &PassFeatures::grab);
  take(Feature::externalForces, &PassFeatures::externalForces);
  take(Feature::cuts, &PassFeatures::cuts);
  take(Feature::movingPins, &PassFeatures::movingPins);
  take(Feature::colliders, &PassFeatures::colliderTypes, &PassFeatures::movingColliders,
       &PassFeatures::coulombFriction);
  take(Feature::planes, &PassFeatures::contactPlanes);
  take(Feature::history, &PassFeatures::history);
  take(Feature::surface, &PassFeatures::surface);
  take(Feature::smallColliders, &PassFeatures::smallColliders);
  return features;
}

gl::Defines definesFor(const PassFeatures& features) {
  return {{"WORK_GROUP_COLUMNS", std::to_string(features.groupColumns)},
          {"WORK_GROUP_ROWS", std::to_string(features.groupRows)},
          {"LOADS_FROM_STORAGE", std::to_string(features.storageLoads)},
          {"HAS_WIND", std::to_string(features.wind)},
          {"ACTIVE_FORCES", std::to_string(features.particleForces) + "u"},
          {"COLLIDER_TYPES", std::to_string(features.colliderTypes) + "u"},
          {"HAS_COULOMB_FRICTION", std::to_string(features.coulombFriction)},
          {"HAS_MOVING_COLLIDERS", std::to_string(features.movingColliders)},
          {"HAS_MOVING_PINS", std::to_string(features.movingPins)},
          {"HAS_REST_LENGTH_TABLE", std::to_string(features.restLengthTable)},
          {"HAS_MATERIAL", std::to_string(features.material)},
          {"HAS_MESH", std::to_string(features.mesh)},
          {"HAS_SEAMS", std::to_string(features.seams)},
          {"HAS_LIMIT_SPRINGS", std::to_string(features.limitSprings)},
          {"HAS_CONTACT_PLANES", std::to_string(features.contactPlanes)},
          {"HAS_SURFACE", std::to_string(features.surface)},
          {"HAS_SMALL_COLLIDERS", std::to_string(features.smallColliders)},
          {"HAS_HISTORY", std::to_string(features.history)},
          {"HAS_GRAB", std::to_string(features.grab)},
          {"HAS_JET", std::to_string(features.jet)},
          {"HAS_EXTERNAL_FORCES", std::to_string(features.externalForces)},
          {"HAS_CUTS", std::to_string(features.cuts)},
          {"GATE", std::to_string(features.gate)},
          {"ENABLED_SLOTS", std::to_string(features.enabledSlots) + "u"}};
}

const std::vector<Kernel>& kernels() {
  const auto sumKind = [](int kind) {
    return std::pair<std::string, std::string>{"SUM_KIND", std::to_string(kind)};
  };
  const auto sum = [&](Pass pass, int kind) {
    return Kernel{{pass}, {{"implicit/sum", Over::sumBlocks, {sumKind(kind)}}}};
  };
  // Conjugate gradients: with the preconditioner, from the particles' residuals down the levels and back,
  // goes what is done before and after it at the same particles.
  const auto precondition = [&](bool updates, Pass sumPass, int kind) {
    const std::pair<std::string, std::string> update{"UPDATES_SOLUTION", updates ? "1" : "0"};
    Kernel kernel{{Pass::restrict, Pass::solveCoarsest, Pass::prolong, sumPass},
                  {{"implicit/restrict_levels", Over::restrictions, {update}},
                   {"implicit/prolong", Over::prolongations},
                   {"implicit/prolong_particles", Over::sumBlocks, {update, sumKind(kind)}}}};
    if (updates) kernel.passes.insert(kernel.passes.begin(), Pass::updateSolution);
    return kernel;
  };
  const auto isSum = [](bool is) { return std::pair<std::string, std::string>{"IS_SUM", is ? "1" : "0"}; };
  const std::vector<KernelStage> search{{"implicit/search", Over::sumBlocks, {sumKind(SUM_STEP)}}};
  static const std::vector<Kernel> all{
      {{Pass::updateDirection, Pass::multiply, Pass::sumCurvature}, search, For::one, Array::directions},
      {{Pass::updateDirection, Pass::multiplyPairs, Pass::multiply, Pass::sumCurvature},
       search,
       For::one,
       Array::directions},
      {{Pass::tryLengths, Pass::sumEnergies},
       {{"implicit/try_lengths", Over::sumBlocks, {isSum(true), sumKind(SUM_LENGTH)}}},
       For::one},
      {{Pass::accept, Pass::measureUpdate},
       {{"implicit/accept", Over::sumBlocks, {isSum(true), sumKind(SUM_UPDATE)}}}},
      {{Pass::limit, Pass::watchLimit}, {{"limit_tile", Over::tiles}}, For::tiles, Array::newPositions},
      {{Pass::limit, Pass::limit}, {{"limit_slot", Over::slots}}, For::sameSlots, Array::newPositions},
      precondition(false, Pass::sumFirstResidual, SUM_FIRST),
      precondition(true, Pass::sumNextResidual, SUM_NEXT),
      {{Pass::forces, Pass::integrate, Pass::collide}, {{"step", Over::grids, {{"COLLIDES_IN_STEP", "1"}}}}},
      {{Pass::forces, Pass::integrate}, {{"step", Over::grids, {{"COLLIDES_IN_STEP", "0"}}}}},
      {{Pass::forces, Pass::kick}, {{"kick", Over::grids}}},
      {{Pass::checkStart}, {{"start", Over::grids}}},
      {{Pass::forces}, {{"forces", Over::grids}}},
      {{Pass::integrate}, {{"integrate", Over::grids}}},
      {{Pass::begin}, {{"implicit/begin", Over::grids}}},
      {{Pass::findPlanes}, {{"implicit/find_planes", Over::grids, {{"PREDICTS", "0"}}}}},
      {{Pass::predictPlanes}, {{"implicit/find_planes", Over::grids, {{"PREDICTS", "1"}}}}},
      {{Pass::elasticForces}, {{"forces", Over::grids}}},
      {{Pass::linearize}, {{"implicit/linearize", Over::grids}}},
      {{Pass::findCenters}, {{"implicit/find_centers", Over::levels}}},
      {{Pass::coarsen},
       {{"implicit/coarsen_elements", Over::firstLevels}, {"implicit/coarsen_blocks", Over::furtherBlocks}},
       For::groups},
      {{Pass::coarsen},
       {{"implicit/coarsen_elements", Over::firstLevels}, {"implicit/coarsen", Over::furtherLevels}}},
      {{Pass::invertDense}, {{"implicit/invert_dense", Over::parts}}},
      {{Pass::restrict}, {{"implicit/restrict", Over::levels}}},
      {{Pass::solveCoarsest}, {{"implicit/solve_coarsest", Over::parts}}},
      {{Pass::prolong}, {{"implicit/prolong", Over::levels}}},
      sum(Pass::sumFirstResidual, SUM_FIRST),
      {{Pass::updateDirection}, {{"implicit/update_direction", Over::particles}}},
      {{Pass::multiply}, {{"implicit/multiply", Over::grids}}},
      sum(Pass::sumCurvature, SUM_STEP),
      {{Pass::updateSolution}, {{"implicit/update_solution", Over::particles}}},
      sum(Pass::sumNextResidual, SUM_NEXT),
      {{Pass::stopAtPlanes}, {{"implicit/stop_at_planes", Over::particles}}},
      {{Pass::tryLengths}, {{"implicit/try_lengths", Over::grids, {isSum(false)}}}},
      sum(Pass::sumEnergies, SUM_LENGTH),
      {{Pass::accept}, {{"implicit/accept", Over::particles, {isSum(false)}}}},
      sum(Pass::measureUpdate, SUM_UPDATE),
      {{Pass::end}, {{"implicit/end", Over::grids}}},
      {{Pass::remember}, {{"implicit/remember", Over::grids}}},
      {{Pass::countStep}, {{"implicit/count_step", Over::once}}},
      {{Pass::collide}, {{"collide", Over::grids}}},
      {{Pass::limit}, {{"limit", Over::colors}}},
      {{Pass::watchLimit}, {{"watch_limit", Over::grids}}},
  };
  return all;
}

namespace {

bool runsOverLevels(Pass pass) {
  const Domain domain = traitsOf(pass).domain;
  return (domain == Domain::coarseVertices && pass != Pass::solveCoarsest) || domain == Domain::fineVertices;
}

// How many of the passes a kernel takes; 0: it does not begin with them.
std::size_t passesOf(const Kernel& kernel, std::span<const PassCall> passes) {
  std::size_t count = 0;
  for (const Pass own : kernel.passes) {
    if (count == passes.size() || passes[count].pass != own) return 0;
    ++count;
    const bool standsForAll = runsOverLevels(own) || kernel.cloths == For::tiles;
    if (kernel.passes.size() == 1 || !standsForAll) continue;
    while (count < passes.size() && passes[count].pass == own) ++count;
  }
  return count;
}

bool isFor(For cloths, const KernelOptions& options) {
  switch (cloths) {
    case For::all:
      return true;
    case For::one:
      return options.oneCloth;
    case For::sameSlots:
      return options.sameSlots;
    case For::tiles:
      return options.tiles;
    case For::groups:
      return options.groups;
  }
  return false;
}

}  // namespace

KernelChoice kernelFor(std::span<const PassCall> passes, const KernelOptions& options) {
  for (std::size_t number = 0; number < kernels().size(); ++number) {
    const Kernel& kernel = kernels()[number];
    if (!options.fused && kernel.passes.size() > 1 && kernel.passes.back() != Pass::kick) continue;
    if (!isFor(kernel.cloths, options)) continue;
    if (const std::size_t count = passesOf(kernel, passes); count > 0) return {number, count};
  }
  assert(false && "every pass has a kernel, and the kick one with the forces");
  return {};
}

std::vector<const gl::Program*> PassLibrary::find(const Kernel& kernel, const PassFeatures& features) {
  Features seen;
  for (const Pass pass : kernel.passes) seen = seen | traitsOf(pass).features;
  PassFeatures own = restricted(features, seen);
  own.gate = static_cast<int>(traitsOf(kernel.passes.front()).gate);
  std::vector<const gl::Program*> programs;
  for (const KernelStage& stage : kernel.stages) {
    PassFeatures ofStage = own;
    if (stage.over != Over::grids || features.mesh) {
      ofStage.groupColumns *= ofStage.groupRows;
      ofStage.groupRows = 1;
    }
    if (stage.over == Over::sumBlocks || stage.over == Over::tiles) ofStage.groupColumns = SUM_LANES;
    if (stage.over == Over::restrictions) ofStage.groupColumns = features.coarseLanes;
    if (stage.over == Over::parts) ofStage.groupColumns = std::max(features.coarseLanes, SUM_LANES);
    if (stage.over == Over::furtherBlocks) ofStage.groupColumns = COARSE_BLOCK_LANES;
    gl::Defines defines = definesFor(ofStage);
    defines.insert(defines.end(), stage.defines.begin(), stage.defines.end());
    std::string name = stage.shader;
    for (const auto& [macro, value] : stage.defines) name += " " + macro + "=" + value;
    auto found = programs_.find({name, ofStage});
    if (found == programs_.end())
      found = programs_
                  .emplace(std::pair{name, ofStage},
                           gl::Program::makeCompute("sim/" + stage.shader + ".comp", defines))
                  .first;
    programs.push_back(&found->second);
  }
  return programs;
}

}  // namespace clothsim
