// A sheet of a material, in explicit steps that are surely stable.
#pragma once

#include "cloth/material.h"

namespace clothsim::test {

inline Scene materialSheet(int columns, int rows, double width, double height, const Material& material) {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.width = width;
  cloth.height = height;
  cloth.numWidthPoints = columns;
  cloth.numHeightPoints = rows;
  cloth.material = material;
  scene.gravity = {0, -9.81, 0};
  scene.solver.integrator = Integrator::euler;
  scene.solver.framesPerSec = 60;
  scene.solver.maxStrain = 1e6;
  scene.solver.simulationSteps = stableSteps(scene);
  return scene;
}

}  // namespace clothsim::test
