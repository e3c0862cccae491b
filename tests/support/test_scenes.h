// Small scenes for tests of the solver, made in code.
#pragma once

#include "scene/scene.h"

namespace clothsim::test {

// A square sheet of n x n points in CS184's model, without limiter and self-collision.
inline Scene sheetScene(int n) {
  Scene scene;
  scene.cloths[0].ks = 5000;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = n;
  return scene;
}

// Two points, the first pinned, the second hanging `length` [m] below it on a spring of `stiffness` [N/m];
// mass [kg] of the free one. Without gravity. The velocities start synchronously, as in every scene without
// `ks`.
inline Scene springScene(double length, double stiffness, double mass, double timeStep,
                         Integrator integrator) {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.width = 1;
  cloth.height = length;
  cloth.numWidthPoints = 1;
  cloth.numHeightPoints = 2;
  cloth.rotation = {90, 0, 0};  // (0, 0, v) to (0, -v, 0)
  cloth.position = {0, -1, 0};  // the pin at the origin
  cloth.mass = 2 * mass;
  cloth.stiffnessReference = stiffness;
  cloth.referenceLength = length;
  cloth.damping = 0;
  cloth.pinned = {GridPoint{0, 0}};
  scene.gravity = {0, 0, 0};
  scene.solver.integrator = integrator;
  scene.solver.simulationSteps = 1;
  scene.solver.framesPerSec = 1 / timeStep;
  return scene;
}

}  // namespace clothsim::test
