// One free particle among colliders.
#pragma once

#include "solver/cpu/cpu_solver.h"
#include "support/test_scenes.h"

namespace clothsim::test {

// With another one far away that keeps the spring slack.
inline Scene particleScene(const Collider& collider, double timeStep, FrictionLaw law = FrictionLaw::cs184) {
  Scene scene = springScene(1, 1e-9, 1, timeStep, Integrator::euler);
  scene.cloths[0].pinned.clear();
  scene.colliders = {collider};
  scene.solver.maxStrain = 1e6;  // the slack spring is no divergence
  scene.solver.frictionLaw = law;
  return scene;
}

struct LoneParticle {
  Vec3d x, v;
};

// After `steps` steps; the velocity is the one at the end of the last.
template <class Real = double>
LoneParticle afterSteps(const Scene& scene, LoneParticle start, int steps = 1) {
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.setPosition(0, {Real(0), Real(500), Real(0)});
  solver.setPosition(1, start.x.cast<Real>());
  solver.setVelocity(1, start.v.cast<Real>());
  solver.step(steps);
  return {solver.position(1).template cast<double>(), solver.velocity(1).template cast<double>()};
}

}  // namespace clothsim::test
