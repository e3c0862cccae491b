// The assignments' scenes end where their own programs, run in double precision, end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "measure/measure.h"
#include "scene_io/scene_io.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/synchronized.h"

namespace clothsim {
namespace {

TEST(Pinned2, HangsWhereTheDoublePrecisionReferenceHangs) {
  const Scene scene = loadSceneByName("pinned2");
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(300 * scene.solver.simulationSteps);
  const Measures measures = measure(cloth, scene, solver.state());
  std::printf("pinned2, frame 300: centroid %.4f %.4f %.4f, lowest %.4f, largest stretch %.3f\n",
              measures.centroid.x, measures.centroid.y, measures.centroid.z, measures.minY,
              1 + measures.maxStrain);
  EXPECT_NEAR(measures.centroid.x, 0.500, 0.001);
  EXPECT_NEAR(measures.centroid.y, 0.430, 0.001);
  EXPECT_NEAR(measures.centroid.z, 0.000, 0.001);
  EXPECT_NEAR(measures.minY, -0.083, 0.001);
  EXPECT_NEAR(1 + measures.maxStrain, 1.12, 0.015);
}

TEST(Cs171, ComesToRestByTheResistanceOfTheAirAlone) {
  const Scene scene = loadSceneByName("cs171");
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const State start = solver.state();
  const int framesPerSecond = static_cast<int>(scene.solver.framesPerSec);
  double peak = 0;
  std::vector<double> means;  // of the kinetic energy over 5 s each
  State state;
  for (int window = 0; window < 24; ++window) {
    double sum = 0;
    for (int frame = 0; frame < 5 * framesPerSecond; ++frame) {
      solver.step(scene.solver.simulationSteps);
      state = solver.state();
      const double energy = measure(cloth, scene, synchronized(cloth, scene, state)).kineticEnergy;
      peak = std::max(peak, energy);
      sum += energy;
    }
    means.push_back(sum / (5 * framesPerSecond));
  }
  std::printf("cs171: kinetic energy over its peak %.2e at 60 s, %.2e at 120 s\n", means[11] / peak,
              means[23] / peak);
  EXPECT_LE(means[11] / peak, 1e-3) << "at 60 s";
  EXPECT_LE(means[23] / peak, 1e-4) << "at 120 s";
  for (const std::size_t corner : {std::size_t{0}, std::size_t{39}}) {
    EXPECT_EQ(state.positions[corner].x, start.positions[corner].x);
    EXPECT_EQ(state.positions[corner].y, start.positions[corner].y);
    EXPECT_EQ(state.positions[corner].z, start.positions[corner].z);
  }
  // A sheet that hangs from two corners, its lower edge in a shallow curve: lowest in the middle, higher at
  // the ends.
  const auto lowerEdge = [&](std::size_t column) { return state.positions[29 * 40 + column].y; };
  EXPECT_LT(lowerEdge(20), lowerEdge(0));
  EXPECT_NEAR(lowerEdge(0), lowerEdge(39), 0.01);
  EXPECT_LT(lowerEdge(0) - lowerEdge(20), 0.5);
}

}  // namespace
}  // namespace clothsim
