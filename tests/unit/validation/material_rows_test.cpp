// Rows that tell a material, by explicit steps with friction until nothing moves: sag, patch test,
// cantilever.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cloth/material.h"
#include "solver/cpu/cpu_solver.h"
#include "support/material_sheet.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

using test::materialSheet;

template <class Real>
void stepFor(CpuSolver<Real>& solver, const Scene& scene, double seconds) {
  solver.step(static_cast<int>(std::ceil(seconds / stepLength(scene.solver))));
}

struct Hung {
  double sag, reaction;
};

// A sheet of 1 m hung from its upper edge: how far the middle of its lower edge sinks, and what its pins
// carry.
template <class Real>
Hung hungSheet(int n) {
  const Material material{.density = 0.1, .stretch = 280, .shear = 105, .bend = 0, .damping = 120};
  Scene scene = materialSheet(n, n, 1, 1, material);
  scene.gravity = {0, 0, 9.81};  // in the sheet's plane, which it then never leaves
  scene.cloths[0].pinned = {GridSide::top};
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  stepFor(solver, scene, 0.6);  // dies down by exp(-60 t)
  const std::vector<Vec3<Real>> forces = solver.forces();
  const Piece& piece = cloth.pieces()[0];
  Hung hung{0, 0};
  for (int column = 0; column < n; ++column) {
    const double mass = piece.particleMass * piece.massWeight(column, 0);
    hung.reaction += static_cast<double>(forces[piece.particle(column, 0)].z) + 9.81 * mass;
  }
  const std::uint32_t lowest = piece.particle(n / 2, n - 1);
  hung.sag = static_cast<double>(solver.position(lowest).z) - cloth.positions()[lowest].z;
  return hung;
}

// Of a square sheet whose Poisson's ratio is 1/3, held over its whole upper edge.
template <class Real>
void expectSagWhatever(std::initializer_list<int> sizes, double tolerance) {
  const std::string row = "sheet hung from its top edge";
  std::vector<double> sags;
  for (const int n : sizes) {
    const Hung hung = hungSheet<Real>(n);
    const std::string size = std::to_string(n) + " x " + std::to_string(n);
    expectNear({row, "reaction, " + size, precisionOf<Real>, "N"}, hung.reaction, 0.1 * 9.81, tolerance);
    sags.push_back(hung.sag);
  }
  for (std::size_t i = 0; i + 1 < sags.size(); ++i)
    expectNear({row,
                "sag over that of the finest, " + std::to_string(sizes.begin()[i]) + " and " +
                    std::to_string(sizes.end()[-1]),
                precisionOf<Real>, ""},
               sags[i] / sags.back(), 1, 1e-3);
  // Without Poisson's effect a strip sags by rho g l^2 / (2 C11) to / (2 Y); C11 = 315 N/m.
  EXPECT_GT(sags.back(), 0.1 * 9.81 / (2 * 320));
  EXPECT_LT(sags.back(), 0.1 * 9.81 / (2 * 270));
}

TEST(RowSheetHungFromItsTopEdge, PullsWithItsWeightAndSagsTheSameAtAnyResolution) {
  expectSagWhatever<double>({33, 49}, 1e-9);
  expectSagWhatever<float>({33, 49}, 1e-3);
}

TEST(RowSheetHungFromItsTopEdge, LongSagsTheSameAt64And128And256Points) {
  expectSagWhatever<double>({64, 128, 256}, 1e-9);
  expectSagWhatever<float>({64, 128, 256}, 1e-3);
}

// Where an affine map that stretches in every direction takes a point of the sheet.
Vec3d stretched(Vec3d x) { return {1.2 * x.x + 0.1 * x.z, 0.4 * x.x - 0.2 * x.z, 0.1 * x.x + 1.1 * x.z}; }

// The border is held there; inside, particles start up to 0.02 m beside it and come to rest.
template <class Real>
double patchError() {
  Scene scene = materialSheet(9, 7, 1, 0.9, {.stretch = 5000, .shear = 500, .bend = 0.01, .damping = 150});
  scene.gravity = {0, 0, 0};
  scene.cloths[0].pinned = {GridSide::top, GridSide::bottom, GridSide::left, GridSide::right};
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    Vec3d x = stretched(cloth.positions()[i]);
    if (cloth.inverseMasses()[i] > 0) x = x + Vec3d{noise(random), noise(random), noise(random)};
    solver.setPosition(i, x.cast<Real>());
  }
  stepFor(solver, scene, 0.5);
  double largest = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d error = solver.position(i).template cast<double>() - stretched(cloth.positions()[i]);
    largest = std::max(largest, std::sqrt(dot(error, error)));
  }
  return largest;
}

TEST(RowPatchTest, IsAffineInsideWhereTheBorderIsMovedAffinely) {
  expectAtMost({"patch test", "largest distance from affine inside", "double", "m"}, patchError<double>(),
               1e-10);
  expectAtMost({"patch test", "largest distance from affine inside", "binary32", "m"}, patchError<float>(),
               1e-5);
}

constexpr double TIP_ALONG = 0.890111, TIP_DOWN = -0.425159;  // of the elastica, w l^3 / B = 4

struct Tip {
  double along, down;
};
// The end of a strip clamped level at one end and bent by its weight, in units of its length.
template <class Real>
Tip cantileverTip(int cells) {
  const double length = 1, density = 0.1, g = 9.81, h = length / cells;
  const Material strip{.density = density,
                       .stretch = 1e4 * density * g * length,
                       .shear = 10 * density * g * length,
                       .bend = density * g * length * length * length / 4,
                       .damping = 6};
  Scene scene = materialSheet(2, cells + 2, h, length + h, strip);  // the clamp is the first cell
  scene.cloths[0].pinned = {GridRange{{0, 0}, {1, 1}}};
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  stepFor(solver, scene, 5);
  const Piece& piece = cloth.pieces()[0];
  const Vec3d clamp = cloth.positions()[piece.particle(0, 1)],
              tip = solver.position(piece.particle(0, cells + 1)).template cast<double>();
  return {(tip.z - clamp.z) / length, (tip.y - clamp.y) / length};
}

double error(Tip tip) { return std::hypot(tip.along - TIP_ALONG, tip.down - TIP_DOWN); }

const std::string cantilever = "cantilever strip, w l^3/B = 4";

void expectTip(const Tip& tip, const char* precision) {
  expectNear({cantilever, "tip along, N = 32", precision, "l"}, tip.along, TIP_ALONG, 2e-3);
  expectNear({cantilever, "tip up, N = 32", precision, "l"}, tip.down, TIP_DOWN, 2e-3);
}

TEST(RowCantileverStrip, BendsToTheElasticaWithSecondOrder) {
  const Tip coarse = cantileverTip<double>(8), middle = cantileverTip<double>(16),
            fine = cantileverTip<double>(32);
  expectTip(fine, "double");
  expectNear({cantilever, "error ratio, N = 8 to 16", "double", ""}, error(coarse) / error(middle), 4, 0.5);
  expectNear({cantilever, "error ratio, N = 16 to 32", "double", ""}, error(middle) / error(fine), 4, 0.5);
}

TEST(RowCantileverStrip, LongBendsToTheElasticaInBinary32Too) {
  expectTip(cantileverTip<float>(32), "binary32");
}

}  // namespace
}  // namespace clothsim::validation
