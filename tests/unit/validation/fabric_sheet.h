// Sheets of fabric in implicit steps of 1/60 s, with the settings that a user gets.
#pragma once

#include <string>

#include "cloth/material.h"
#include "solver/cpu/cpu_solver.h"
#include "support/material_sheet.h"

namespace clothsim::validation {

struct StepKind {
  Integrator integrator = Integrator::implicit;
  Orientation orientation = Orientation::horizontal;
};
[[nodiscard]] inline std::string nameOf(const StepKind& kind) {
  return std::string(integratorName(kind.integrator)) +
         (kind.orientation == Orientation::vertical ? ", vertical grid" : "");
}

[[nodiscard]] inline Scene fabricSheet(const StepKind& kind, int columns, int rows, double width,
                                       double height, const Material& material) {
  Scene scene = test::materialSheet(columns, rows, width, height, material);
  scene.solver = {};
  scene.solver.integrator = kind.integrator;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.cloths[0].orientation = kind.orientation;
  chooseCounts(scene);
  return scene;
}

// A vertical grid stands in the plane of x and y, a level one in that of x and z; where its normal points.
[[nodiscard]] inline Vec3d normalOf(Orientation orientation) {
  return orientation == Orientation::horizontal ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
}

[[nodiscard]] inline std::vector<std::string> threeFabrics() { return {"silk", "cotton", "denim"}; }

}  // namespace clothsim::validation
