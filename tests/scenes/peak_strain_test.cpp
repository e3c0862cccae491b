// How far cloth is stretched on its way, not only in the end.
#include <gtest/gtest.h>

#include <algorithm>

#include "measure/measure.h"
#include "scene_io/scene_options.h"
#include "solver/cpu/cpu_solver.h"

namespace clothsim {
namespace {

// As silk falls into folds, the guard holds back what would come too near. What stops while its neighbours go
// on was stretched by 67 % and by 24 % in these runs; steps of a tenth of the tolerance say 13 %.
TEST(PeakStrain, OfSilkThatFallsIntoFoldsIsThatOfItsFall) {
  const Scene scene = readScene({.scene = "sphere",
                                 .resolution = GridSize{49, 49},
                                 .settings = {"cloth.material=silk", "solver.frames_per_sec=60"}})
                          .scene;
  const Cloth cloth(scene);
  for (const double displacement : {0.0, 1e-5}) {
    CpuSolver<float> solver(cloth, scene);
    State state = solver.state();
    jitter(state, displacement, 2);
    solver.setState(state);
    double peak = 0;
    for (int frame = 0; frame < 32; ++frame) {
      solver.step(scene.solver.simulationSteps);
      peak = std::max(peak, measure(cloth, scene, solver.state()).maxStrain);
    }
    EXPECT_LT(peak, 0.2) << displacement;
    EXPECT_GT(solver.contactCounts().shortened, 0u) << "something was held back";
  }
}

}  // namespace
}  // namespace clothsim
