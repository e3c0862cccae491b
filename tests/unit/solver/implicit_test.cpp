// The implicit integrator: against a sparse direct solver, and what has to hold exactly. Rows with known
// answers are in unit/validation.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/thread_team.h"
#include "scene/pose.h"
#include "solver/cpu/cpu_solver.h"
#include "support/compared_scenes.h"
#include "support/direct_minimum.h"
#include "support/elastic_energy.h"
#include "support/grabs.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

// A horizontal sheet of 1 m x 1 m in steps of 1/60 s.
Scene implicitSheet(int n, const Material& material) {
  Scene scene = test::materialSheet(n, n, 1, 1, material);
  scene.solver.integrator = Integrator::implicit;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  chooseCounts(scene);
  return scene;
}

const Material canvas{.density = 0.2, .stretch = 3000, .shear = 700, .bend = 1e-3, .damping = 2};

// The minimum that a step looks for.
test::DirectMinimum minimumOfStep(const Scene& scene, const Cloth& cloth, const Cuts& cuts,
                                  const CpuSolver<double>& solver) {
  const double h = stepLength(scene.solver), damped = 1 + scene.cloths[0].material->damping * h;
  test::DirectMinimum minimum(test::ElasticEnergy(scene, cloth, cuts), cloth);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const double w = cloth.inverseMasses()[i];
    const Vec3d x = solver.position(i), v = solver.velocity(i);
    minimum.start[i] = w > 0 ? x + (h / damped) * (v + h * scene.gravity) : x;
    minimum.anchors[i] = minimum.start[i];
    minimum.stiffness[i] = w > 0 ? damped / (w * h * h) : 0;
    if (w == 0 || scene.airResistance == 0) continue;  // -a |v| v', v' = (x' - x) / h
    const double air = scene.airResistance * length(v) / h, sum = minimum.stiffness[i] + air;
    minimum.anchors[i] = (1 / sum) * (minimum.stiffness[i] * minimum.start[i] + air * x);
    minimum.stiffness[i] = sum;
  }
  return minimum;
}

// 9 x 9 points held at two corners; fast, turning and swelling, in waves.
Scene fastSheet() {
  Scene scene = implicitSheet(9, canvas);
  scene.cloths[0].pinned = {GridPoint{0, 0}, GridPoint{8, 0}};
  return scene;
}
void makeFast(CpuSolver<double>& solver, const Cloth& cloth) {
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    if (cloth.inverseMasses()[i] == 0) continue;
    const Vec3d x = cloth.positions()[i] - Vec3d{0.5, 1, 0};
    solver.setVelocity(
        i, {3 * x.x + std::sin(5 * x.z), 4 * std::sin(4 * x.x + 3 * x.z), 3 * x.z + std::cos(7 * x.x) * x.z});
  }
}

double largestDifference(const CpuSolver<double>& solver, const std::vector<Vec3d>& x) {
  double most = 0;
  for (std::uint32_t i = 0; i < x.size(); ++i) most = std::max(most, length(solver.position(i) - x[i]));
  return most;
}

struct Effort {
  int newtonSteps, cgIterations;
};

// How far a step ends from the reference with each effort [m]; the third from the start, when springs push as
// well.
std::vector<double> errorsOfThirdStep(Scene scene, const Cuts& cuts, std::initializer_list<Effort> efforts) {
  scene.solver.tolerance = 0;
  scene.solver.newtonSteps = 60;
  scene.solver.cgIterations = 200;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.setCuts(cuts);
  makeFast(solver, cloth);
  solver.step(2);
  const State start = solver.state();
  solver.setState(start);
  const std::vector<Vec3d> expected = minimumOfStep(scene, cloth, cuts, solver).solve();
  std::vector<double> errors;
  for (const Effort effort : efforts) {
    scene.solver.newtonSteps = effort.newtonSteps;
    scene.solver.cgIterations = effort.cgIterations;
    solver.configure(scene);
    solver.setState(start);
    solver.step(1);
    errors.push_back(largestDifference(solver, expected));
  }
  return errors;
}
double errorOfThirdStep(const Scene& scene, const Cuts& cuts, Effort effort) {
  return errorsOfThirdStep(scene, cuts, {effort})[0];
}

TEST(ImplicitStep, IsThatOfADirectSolver) {
  const Scene scene = fastSheet();
  EXPECT_LT(errorOfThirdStep(scene, {}, {60, 200}), 1e-9);
}

TEST(ImplicitStep, IsThatOfADirectSolverWithStrainLimitAndAir) {
  Scene scene = fastSheet();
  scene.solver.strainLimit = 0.02;
  scene.airResistance = 1e-3;
  EXPECT_LT(errorOfThirdStep(scene, {}, {60, 200}), 1e-9);
}

TEST(ImplicitStep, IsThatOfADirectSolverWhereTheSheetIsTorn) {
  const Scene scene = fastSheet();
  EXPECT_LT(errorOfThirdStep(scene, test::someCuts(Cloth(scene)), {80, 200}), 1e-9);
}

// Relative to where it starts, the inertial guess.
TEST(ImplicitStep, IsNearTheDirectSolverWithDefaults) {
  const Scene scene = fastSheet();
  const SolverSettings defaults;
  for (const Cuts& cuts : {Cuts{}, test::someCuts(Cloth(scene))}) {
    const std::vector<double> errors =
        errorsOfThirdStep(scene, cuts, {{0, 1}, {defaults.newtonSteps, defaults.cgIterations}});
    EXPECT_LT(errors[1], (cuts.empty() ? 0.25 : 0.5) * errors[0]);
  }
}

// x = x0 - g h^2 n (n + 1) / 2
TEST(ImplicitStep, FallsFreelyAsBackwardEulerDoes) {
  Material undamped = canvas;
  undamped.damping = 0;
  Scene scene = implicitSheet(12, undamped);
  scene.solver.tolerance = 0;
  scene.solver.newtonSteps = 2;  // what is not solved takes all of them
  scene.solver.cgIterations = 10;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(60);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d expected = cloth.positions()[i] - Vec3d{0, 9.81 * 60 * 61 / 2 / 3600, 0};
    EXPECT_LT(length(solver.position(i) - expected), 1e-12) << i;
  }
}

// Points a power of two apart, so that springs and bending see the lattice to the bit.
TEST(ImplicitStep, LeavesAFlatSheetStillToTheBit) {
  for (const bool material : {true, false}) {
    Scene scene = implicitSheet(33, canvas);
    if (!material) scene.cloths[0] = test::sheetScene(33).cloths[0];
    scene.gravity = {0, 0, 0};
    scene.cloths[0].pinned = {GridPoint{0, 0}};
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(25);
    int moved = 0;
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
      moved += solver.position(i) == startPosition<float>(cloth, i) ? 0 : 1;
    EXPECT_EQ(moved, 0) << material;
  }
}

// Elsewhere binary32 rounds the lattice but not the rest length: that much, and it does not add up.
TEST(ImplicitStep, LeavesAnyFlatSheetWithinTheRoundingOfItsPlaces) {
  Scene scene = implicitSheet(50, canvas);
  scene.gravity = {0, 0, 0};
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(25);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    EXPECT_LT(length((solver.position(i) - startPosition<float>(cloth, i)).cast<double>()), 3e-7) << i;
}

// In 5 steps; relative to the sum of the particles' own.
template <class Real>
double changeOfMomentum(int newtonSteps, int cgIterations) {
  Material undamped = canvas;
  undamped.damping = 0;
  Scene scene = implicitSheet(12, undamped);
  scene.gravity = {0, 0, 0};
  scene.solver.tolerance = 0;
  scene.solver.newtonSteps = newtonSteps;
  scene.solver.cgIterations = cgIterations;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> speed(-1, 1);
  const auto momentum = [&](std::uint32_t i) {
    return (1 / cloth.inverseMasses()[i]) * solver.velocity(i).template cast<double>();
  };
  Vec3d change{};
  double sizes = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    solver.setVelocity(i, Vec3d{speed(engine), speed(engine), speed(engine)}.cast<Real>());
    change = change - momentum(i);
    sizes += length(momentum(i));
  }
  solver.step(5);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) change = change + momentum(i);
  return length(change) / sizes;
}

TEST(ImplicitStep, KeepsTheMomentumOfAFreeSheet) {
  const double converged = changeOfMomentum<double>(20, 100), single = changeOfMomentum<float>(20, 100);
  const double quick = changeOfMomentum<double>(3, 10);
  EXPECT_LT(converged, 1e-11);
  EXPECT_LT(single, 1e-5);
  EXPECT_LT(quick, 1e-2) << "as far as it is solved";
}

TEST(ImplicitStep, GivesTheSameBitsOnAnyNumberOfThreads) {
  Scene scene = implicitSheet(100, canvas);
  scene.cloths[0].pinned = {GridPoint{0, 0}, GridPoint{99, 0}};
  scene.wind = Wind{.velocity = {1, 0.5, -2}, .gust = {}};
  const Cloth cloth(scene);
  const int usual = ThreadTeam::shared().threads();
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    ThreadTeam::setSharedThreads(threads);
    CpuSolver<float> solver(cloth, scene);
    solver.step(3);
    hashes.push_back(stateHash(solver.state()));
  }
  ThreadTeam::setSharedThreads(usual);
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(ImplicitStep, LetsWhatIsCutOffFallFreely) {
  Material undamped = canvas;
  undamped.damping = 0;
  for (const std::uint32_t n : {9u, 34u}) {
    const Scene scene = test::vertical(implicitSheet(static_cast<int>(n), undamped));
    const Cloth cloth(scene);
    CpuSolver<double> solver(cloth, scene);
    const std::uint32_t rowsCutOff = n / 2;
    solver.setCuts(test::cutAcross(cloth, rowsCutOff - 0.5));
    solver.step(30);
    const double expected = 9.81 * 30 * 31 / 2 / 3600;
    // What hangs holds back the start of the search for what falls; few iterations make up for most of that.
    const double tolerance = n == 9 ? 1e-3 : 0.1 * expected;
    for (std::uint32_t i = 0; i < n * rowsCutOff; ++i)
      EXPECT_NEAR(cloth.positions()[i].y - solver.position(i).y, expected, tolerance) << i << " of " << n * n;
    EXPECT_GT(solver.position(n * n - n / 2).y, 0.7) << "the rest hangs on";
    EXPECT_EQ(solver.divergence(), std::nullopt);
  }
}

// The coarsest level is then hundreds of matrices, with elements that reach from one to the next.
TEST(ImplicitStep, LetsCrumbsFallFreely) {
  constexpr int n = 17;
  Scene scene = test::vertical(implicitSheet(n, canvas));
  scene.cloths[0].material->damping = 0;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.setCuts(test::crumbled(cloth));
  solver.step(12);
  const double expected = 9.81 * 12 * 13 / 2 / 3600;
  for (std::uint32_t i = 0; i < n * (n / 2); ++i)
    EXPECT_NEAR(cloth.positions()[i].y - static_cast<double>(solver.position(i).y), expected, 0.02 * expected)
        << i;
}

TEST(ImplicitStep, BringsAHeldParticleNearItsGoal) {
  Scene scene = test::vertical(implicitSheet(9, canvas));
  const Cloth cloth(scene);
  for (const double strength : {1e4, 1e12}) {
    CpuSolver<float> solver(cloth, scene);
    const Vec3d target{0.5, 0.3, 0.4};
    solver.setInteraction(test::grabTo(solver, cloth, scene, 4, target, strength));
    solver.step(90);
    EXPECT_EQ(solver.divergence(), std::nullopt) << strength;
    // A soft hand gives way.
    EXPECT_LT(length(solver.position(4).cast<double>() - target), strength > 1e6 ? 1e-4 : 0.1) << strength;
  }
}

TEST(ImplicitStep, TakesPinsWhereTheirPathSays) {
  Scene scene = implicitSheet(5, canvas);
  scene.cloths[0].pinned = {GridSide::left, GridSide::right};
  PinMotion motion;
  motion.pinned = {GridSide::left};
  motion.keys = {{.t = 0, .position = std::nullopt, .rotation = {}},
                 {.t = 0.5, .position = Vec3d{0.1, 1.2, 0.6}, .rotation = {0, 90, 0}}};
  scene.cloths[0].pinMotion = {motion};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  const Vec3d start{0, 1, 0.5};  // the mean of the left column
  for (const int step : {1, 15, 30, 45}) {
    solver.step(step - static_cast<int>(solver.stepIndex()));
    const double part = std::min(1.0, step / 30.0);
    const Matrix3 turn = rotationMatrix({0, 90 * part, 0});
    for (int row = 0; row < 5; ++row) {
      const std::uint32_t left = cloth.pieces()[0].particle(0, row),
                          right = cloth.pieces()[0].particle(4, row);
      const Vec3d expected =
          start + part * Vec3d{0.1, 0.2, 0.1} + rotate(turn, cloth.positions()[left] - start);
      EXPECT_LT(length(solver.position(left) - expected), 1e-12) << step;
      EXPECT_EQ(solver.position(right), cloth.positions()[right]) << step;
    }
  }
}

// With three steps a frame, the last step of a frame and the first one of the next both make levels.
TEST(ImplicitStep, GoesOnFromAnyFrameAsIfNothingHadHappened) {
  Scene scene = fastSheet();
  scene.solver.simulationSteps = 3;
  const Cloth cloth(scene);
  CpuSolver<float> whole(cloth, scene);
  whole.step(15);
  for (const int frames : {1, 2, 3}) {
    CpuSolver<float> first(cloth, scene), second(cloth, scene);
    first.step(3 * frames);
    second.setState(first.state());
    second.step(15 - 3 * frames);
    EXPECT_EQ(stateHash(whole.state()), stateHash(second.state())) << frames;
  }
}
// An edit may make the kept levels wrong: the next step makes its own.
TEST(ImplicitStep, MakesNewLevelsAfterAnEdit) {
  Scene scene = fastSheet();
  scene.solver.simulationSteps = 4;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const auto makesLevels = [&] {
    bool found = false;
    for (const PassTime& time : solver.timePasses(1)) found = found || time.name.starts_with("coarsen");
    return found;
  };
  EXPECT_TRUE(makesLevels());
  EXPECT_FALSE(makesLevels());
  EXPECT_TRUE(makesLevels());
  solver.setPin(40, true);
  EXPECT_TRUE(makesLevels());
}

}  // namespace
}  // namespace clothsim
