// Rows on meshes that are stiffer in one half than in the other: how far a strip hangs down, and how far one
// that is clamped bends.
#include <gtest/gtest.h>

#include <string>

#include "solver/cpu/cpu_solver.h"
#include "support/mesh_sheet.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

constexpr int CELLS = 40;  // along the strip, 4 across

// A strip along x from its clamp at 0, its first half painted red and its second half green; one more row of
// cells lies behind the clamp.
std::string stripFile(double length) {
  const double h = length / CELLS;
  std::string text;
  for (int column = -1; column <= CELLS; ++column)
    for (int row = 0; row <= 4; ++row)
      text += "v " + std::to_string(column * h) + " " + std::to_string(row * h) + " 0 " +
              (2 * column <= CELLS ? "1 " : "0 ") + (2 * column >= CELLS ? "1 0\n" : "0 0\n");
  for (int column = 0; column <= CELLS; ++column)
    for (int row = 0; row < 4; ++row) {
      const int a = 5 * column + row + 1, b = a + 5, c = a + 1, d = b + 1;
      const auto face = [&](int p, int q, int r) {
        text += "f " + std::to_string(p) + " " + std::to_string(q) + " " + std::to_string(r) + "\n";
      };
      (column + row) % 2 == 0 ? (face(a, b, d), face(a, d, c)) : (face(a, b, c), face(b, d, c));
    }
  return test::meshFile(text);
}

// How far the end of the strip has moved under gravity once it is at rest [m].
template <class Real>
Vec3d movedEnd(double length, const Material& material, Vec3d gravity,
               const std::vector<StiffnessPart>& map) {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.mesh = stripFile(length);
  cloth.material = material;
  cloth.material->damping = 20;
  cloth.pinned = {RegionPin{{{-1, -1, -1}, {1e-6, 1, 1}}}};
  cloth.stiffnessMap = map;
  scene.gravity = gravity;
  scene.solver.integrator = Integrator::implicit;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  scene.solver.tolerance = 1e-4;
  scene.solver.cgIterations = 300;
  const Cloth made(scene);
  CpuSolver<Real> solver(made, scene);
  solver.step(90);
  const std::uint32_t end = made.particleCount() - 3;  // the middle of the free side
  return solver.position(end).template cast<double>() - made.positions()[end];
}

// Each part stretches by its own weight and by that of what hangs from it: rho g L^2 / Y times 3/8 and 1/8,
// the second half twice as stiff.
template <class Real>
void expectSag() {
  constexpr double LENGTH = 1, DENSITY = 0.2, STRETCH = 2000;
  const Material material{.density = DENSITY, .stretch = STRETCH, .shear = 20, .bend = 1e-6};
  const double sag =
      movedEnd<Real>(LENGTH, material, {GRAVITY, 0, 0}, {{{PaintedPin{Paint::green}}, 2, 1}}).x;
  expectNear(
      {"stiffness map", "sag of a strip whose lower half is twice as stiff over rho g L^2 (3/8 + 1/16) / Y",
       precisionOf<Real>, ""},
      sag / (DENSITY * GRAVITY * LENGTH * LENGTH / STRETCH * (3.0 / 8 + 1.0 / 16)), 1, 0.01);
}

TEST(RowStiffnessMap, LetsAStripSagByTheSumOfItsParts) {
  expectSag<double>();
  expectSag<float>();
}

// The end of a clamped strip sinks by the integral of M (L - s) / B, M = rho g (L - s)^2 / 2: 15/16 of it
// comes from the first half.
template <class Real>
void expectBend() {
  constexpr double LENGTH = 0.2, FACTOR = 4;
  const Material material{.density = 0.05, .stretch = 5000, .shear = 1000, .bend = 0.05};
  const auto sinks = [&](const std::vector<StiffnessPart>& map) {
    return movedEnd<Real>(LENGTH, material, {0, 0, -GRAVITY}, map).z;
  };
  const double plain = sinks({});
  expectNear(
      {"stiffness map",
       "end of a clamped strip whose first half bends 4 times as hard, over that of one alike everywhere",
       precisionOf<Real>, ""},
      sinks({{{PaintedPin{Paint::red}}, 1, FACTOR}}) / plain, (15.0 / FACTOR + 1) / 16, 0.01);
}

TEST(RowStiffnessMap, LetsAClampedStripBendByTheSumOfItsParts) {
  expectBend<double>();
  expectBend<float>();
}

}  // namespace
}  // namespace clothsim::validation
