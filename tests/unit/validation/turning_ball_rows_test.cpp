// A sheet of fabric that a turning ball carries along, with the settings that a user gets.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "measure/measure.h"
#include "scene_io/scene_io.h"
#include "solver/cpu/cpu_solver.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

constexpr double SPEED = 90;  // of the ball [degrees/s]

Scene turningBall(const std::string& fabric, int points) {
  const std::string count = std::to_string(points);
  return parseScene(R"({
    "cloth": {"width": 1, "height": 1, "num_width_points": )" +
                        count + R"(, "num_height_points": )" + count + R"(, "material": ")" + fabric +
                        R"(", "position": [-0.5, -0.28, -0.5]},
    "colliders": [{"type": "sphere", "origin": [0, 0.4, 0], "radius": 0.3, "friction": 0.4,
                   "motion": {"keys": [{"t": 0}, {"t": 20, "rotation": [0, 1800, 0]}]}}],
    "solver": {"frames_per_sec": 60}})",
                    "turning ball");
}

// Between neighbours along rows and columns.
double largestStrainOfThreads(const Cloth& cloth, const State& state) {
  const Piece& piece = cloth.pieces()[0];
  double largest = 0;
  const auto look = [&](std::uint32_t a, std::uint32_t b, double rest) {
    const Vec3d between = (vectorOf(state.positions[b]) - vectorOf(state.positions[a])).cast<double>();
    largest = std::max(largest, std::abs(length(between) / rest - 1));
  };
  for (int row = 0; row < piece.rows; ++row)
    for (int column = 0; column < piece.columns; ++column) {
      if (column > 0)
        look(piece.particle(column - 1, row), piece.particle(column, row), piece.nominalLength[toLeft]);
      if (row > 0)
        look(piece.particle(column, row - 1), piece.particle(column, row), piece.nominalLength[toUpper]);
    }
  return largest;
}

// The sheet's middle column lies on the ball; how far a particle of it, off the axis, has turned [degrees].
double turnOf(const Cloth& cloth, const State& state, int points) {
  const auto place =
      vectorOf(state.positions[cloth.pieces()[0].particle(points / 2, points / 2 - points / 8)]);
  return std::atan2(static_cast<double>(place.x), static_cast<double>(place.z)) * 180 / std::numbers::pi;
}

void expectCarriedAlong(const std::string& fabric, int points, int settlingFrames) {
  const Scene scene = turningBall(fabric, points);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const auto steps = static_cast<std::uint32_t>(scene.solver.simulationSteps);
  solver.step(steps * static_cast<std::uint32_t>(settlingFrames));
  const double before = turnOf(cloth, solver.state(), points);
  const auto unsolvedBefore = solver.convergenceCounts().unconvergedSteps;
  double least = INFINITY, most = 0;
  constexpr int frames = 60;
  for (int frame = 0; frame < frames; ++frame) {
    solver.step(steps);
    const double strain = measure(cloth, scene, solver.state()).maxStrain;
    least = std::min(least, strain);
    most = std::max(most, strain);
  }
  const State state = solver.state();
  const double turned = std::remainder(turnOf(cloth, state, points) - before - SPEED, 360);
  const std::string row = "sheet on a turning ball",
                    what = ", " + fabric + ", " + std::to_string(points) + "^2";
  if (fabric != "jersey")  // which is knitted, and gives way
    expectAtMost({row, "strain of threads" + what, precisionOf<float>, "",
                  "a woven cloth lies on a ball by shear, which does not stretch threads"},
                 largestStrainOfThreads(cloth, state), 0.005);
  expectAtMost({row, "wander of the largest strain in 1 s" + what, precisionOf<float>, ""}, most - least,
               0.005);
  expectAtMost({row, "lag in 1 s" + what, precisionOf<float>, "degrees"}, std::abs(turned), 0.05);
  EXPECT_EQ(solver.convergenceCounts().unconvergedSteps, unsolvedBefore);
}

TEST(RowSheetOnATurningBall, IsCarriedAlongAndNotStretched) { expectCarriedAlong("cotton", 17, 90); }

TEST(RowSheetOnATurningBall, LongIsCarriedAlongAndNotStretched) {
  for (const char* fabric : {"silk", "cotton", "denim", "wool", "jersey"})
    for (const int points : {17, 33, 65}) expectCarriedAlong(fabric, points, 300);
}

}  // namespace
}  // namespace clothsim::validation
