// Fabrics in implicit steps of 1/60 s with the settings that a user gets: what converged steps do.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cloth/material.h"
#include "solver/cpu/cpu_solver.h"
#include "support/material_sheet.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

Scene implicitSheet(int columns, int rows, double width, double height, const Material& material) {
  Scene scene = test::materialSheet(columns, rows, width, height, material);
  scene.solver = {};
  scene.solver.integrator = Integrator::implicit;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  chooseCounts(scene);
  return scene;
}

// A strip over an edge, twice as long as the length (B / rho g)^(1/3): its chord hangs down by 41.5 degrees
// (F. T. Peirce, 1930).
template <class Real>
double overhangAngle(const Material& material, int cells) {
  const double length = 2 * std::cbrt(material.bend / (material.density * GRAVITY)), h = length / cells;
  Scene scene = implicitSheet(cells + 2, 5, h * (cells + 1), 4 * h, material);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 2; ++column) scene.cloths[0].pinned.push_back(GridPoint{column, row});
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(6 * 60);
  const Piece& piece = cloth.pieces()[0];
  const Vec3d chord = solver.position(piece.particle(cells + 1, 2)).template cast<double>() -
                      solver.position(piece.particle(1, 2)).template cast<double>();
  return std::atan2(-chord.y, chord.x) * 180 / std::numbers::pi;
}

TEST(RowFabricOverAnEdge, HangsAtTheAngleOfItsBendingLength) {
  for (const std::string fabric : {"silk", "denim", "jersey"})
    expectNear({"fabric over an edge", "angle of the chord, " + fabric + ", 20 cells", precisionOf<float>,
                "degrees"},
               overhangAngle<float>(*materialPreset(fabric), 20), 41.5, 0.5);
}

// By the last rows' own weight: rho g L^2 / 2 Y, where Poisson's effect makes little of it.
TEST(RowFabricStanding, SagsByItsWeight) {
  for (const std::string fabric : {"silk", "denim"}) {
    const Material material = *materialPreset(fabric);
    Scene scene = implicitSheet(33, 33, 1, 1, material);
    scene.cloths[0].orientation = Orientation::vertical;
    scene.cloths[0].pinned = {GridSide::top};
    const Cloth cloth(scene);
    CpuSolver<double> solver(cloth, scene);
    solver.step(2 * 60);
    double sag = 0;
    for (int column = 0; column < 33; ++column) {
      const std::uint32_t i = cloth.pieces()[0].particle(column, 0);
      sag += (cloth.positions()[i].y - solver.position(i).y) / 33;
    }
    const double expected = material.density * GRAVITY / (2 * material.stretch);
    expectNear({"standing fabric", "sag of the lower edge, " + fabric, precisionOf<double>, "m"}, sag,
               expected, 0.05 * expected);
  }
}

}  // namespace
}  // namespace clothsim::validation
