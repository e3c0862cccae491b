#include "scene_io/solver_defaults.h"

#include <algorithm>

#include "cloth/material.h"

namespace clothsim {

SelfCollision usualSelfCollision(bool usesKs, bool usesMaterial, Integrator integrator) {
  if (usesMaterial && isImplicit(integrator)) return SelfCollision::contact;
  if (usesKs) return SelfCollision::averaged;
  return usesMaterial ? SelfCollision::robust : SelfCollision::off;
}

SolverSettings solverDefaults(bool usesKs, bool usesMaterial) {
  SolverSettings solver;
  if (usesMaterial) {
    solver.frictionLaw = FrictionLaw::coulomb;
    solver.integrator = Integrator::implicit;
    solver.simulationSteps.automatic = true;
  }
  if (usesKs) solver.strainLimit = 0.1;
  solver.selfCollision = usualSelfCollision(usesKs, usesMaterial, solver.integrator);
  return solver;
}

void setIntegrator(Scene& scene, Integrator integrator) {
  SolverSettings& solver = scene.solver;
  const auto usual = [&] {
    return usualSelfCollision(usesKs(scene), usesMaterial(scene), solver.integrator);
  };
  const bool wasUsual = solver.selfCollision == usual();
  solver.integrator = integrator;
  if (wasUsual) solver.selfCollision = usual();
  if (solver.selfCollision == SelfCollision::contact && !isImplicit(integrator))
    solver.selfCollision = SelfCollision::robust;
  chooseCounts(scene);
}

bool usesKs(const Scene& scene) {
  return std::any_of(scene.cloths.begin(), scene.cloths.end(),
                     [](const ClothSettings& cloth) { return !cloth.stiffnessReference && !cloth.material; });
}

}  // namespace clothsim
