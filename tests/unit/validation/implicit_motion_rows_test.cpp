// Rows on how well the implicit integrator's few iterations solve a step, and keep a strain limit.
#include <gtest/gtest.h>

#include <cmath>

#include "cloth/material.h"
#include "measure/measure.h"
#include "solver/cpu/cpu_solver.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

// A sheet of 1 m x 1 m, level at the start, in steps of 1/60 s.
Scene levelSheet(int points, const Material& material) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = points;
  scene.cloths[0].material = material;
  scene.gravity = {0, -9.81, 0};
  scene.solver.integrator = Integrator::implicit;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  return scene;
}

void solveWith(Scene& scene, int newtonSteps, int cgIterations) {
  scene.solver.newtonSteps = newtonSteps;
  scene.solver.cgIterations = cgIterations;
}

// A sheet of width W, held by two clips of W/32: structural springs of 1e4 N/m and shear
// springs of 5e3 N/m, that is C11 = 15000 N/m and G = 5000 N/m. (Its weak springs over two cells are left
// out.)
Scene clippedSheet(int points) {
  const double c11 = 15'000, shear = 5000;
  Scene scene = levelSheet(
      points,
      {.density = 0.2, .stretch = c11 - shear * shear / c11, .shear = shear, .bend = 0, .damping = 2});
  const int clip = static_cast<int>(std::lround((points - 1) / 32.0)), last = points - 1;
  scene.cloths[0].pinned = {GridRange{{0, 0}, {clip, 0}}, GridRange{{last - clip, 0}, {last, 0}}};
  return scene;
}

struct Motion {
  std::vector<Vec3d> positions, velocities;
  State state;  // in binary32, and what held the particles up
};
template <class Real>
Motion motionOf(CpuSolver<Real>& solver, std::uint32_t particles) {
  Motion motion;
  motion.state = solver.state();
  for (std::uint32_t i = 0; i < particles; ++i) {
    motion.positions.push_back(solver.position(i).template cast<double>());
    motion.velocities.push_back(solver.velocity(i).template cast<double>());
  }
  return motion;
}
template <class Real>
std::vector<Vec3d> stepFrom(const Motion& motion, const Cloth& cloth, const Scene& scene) {
  CpuSolver<Real> solver(cloth, scene);
  solver.setState(motion.state);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    solver.setPosition(i, motion.positions[i].cast<Real>());
    solver.setVelocity(i, motion.velocities[i].cast<Real>());
  }
  solver.step(1);
  return motionOf(solver, cloth.particleCount()).positions;
}
double distance(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum);
}

// Where inertia and gravity alone take the particles: h (v + h g) / (1 + c h) from where they are.
std::vector<Vec3d> inertialGuess(const Motion& motion, const Cloth& cloth, const Scene& scene) {
  const double h = stepLength(scene.solver), time = h / (1 + scene.cloths[0].material->damping * h);
  std::vector<Vec3d> places = motion.positions;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    if (cloth.inverseMasses()[i] > 0)
      places[i] = places[i] + time * (motion.velocities[i] + h * scene.gravity);
  return places;
}

// One unit is one pass over all springs: CG iterations, and two more a Newton step.
struct Effort {
  int newtonSteps, cgIterations, units;
  double demanded;
};
constexpr Effort efforts[] = {{3, 11, 40, 0.25}, {6, 11, 80, 0.12}};

template <class Real>
void expectNearConverged(const Motion& motion, const Cloth& cloth, Scene scene,
                         const std::vector<Vec3d>& converged, const std::string& when) {
  const double guess = distance(inertialGuess(motion, cloth, scene), converged);
  for (const Effort& effort : efforts) {
    solveWith(scene, effort.newtonSteps, effort.cgIterations);
    expectAtMost({"error of an implicit step over that of the inertial guess",
                  std::to_string(effort.units) + " units, " + when, precisionOf<Real>, ""},
                 distance(stepFrom<Real>(motion, cloth, scene), converged) / guess, effort.demanded);
  }
}

void expectErrorsFall(int points) {
  Scene scene = clippedSheet(points);
  scene.solver.tolerance = 1e-4;  // a step ends with its iterations, not before
  Scene precise = scene;
  const Cloth cloth(scene);
  solveWith(precise, 12, 40);
  CpuSolver<double> solver(cloth, precise);
  for (const int frame : {20, 35}) {
    solver.step(frame - static_cast<int>(solver.stepIndex()));
    const Motion motion = motionOf(solver, cloth.particleCount());
    solveWith(precise, 200, 100);
    const std::vector<Vec3d> converged = stepFrom<double>(motion, cloth, precise);
    solveWith(precise, 240, 100);
    EXPECT_LT(distance(stepFrom<double>(motion, cloth, precise), converged),
              1e-3 * distance(inertialGuess(motion, cloth, scene), converged))
        << "the reference has not converged";
    const std::string when = std::to_string(points) + "^2, frame " + std::to_string(frame);
    expectNearConverged<double>(motion, cloth, scene, converged, when);
    expectNearConverged<float>(motion, cloth, scene, converged, when);
  }
}

TEST(RowErrorOfAnImplicitStep, LongFallsAsIterationsAreSpent) { expectErrorsFall(64); }
TEST(RowErrorOfAnImplicitStep, LongFallsAsIterationsAreSpentOnAFinerSheet) { expectErrorsFall(128); }
TEST(RowErrorOfAnImplicitStep, LongFallsAsIterationsAreSpentOnTheFinestSheet) { expectErrorsFall(256); }

// A soft sheet that swings from two corners and has a limit of 10 %, with the iterations that a user gets.
Scene swingingSheet(int points) {
  Scene scene =
      levelSheet(points, {.density = 0.2, .stretch = 100, .shear = 30, .bend = 1e-5, .damping = 0.1});
  scene.cloths[0].pinned = {GridPoint{0, 0}, GridPoint{points - 1, 0}};
  scene.solver.strainLimit = 0.1;
  chooseCounts(scene);
  return scene;
}

void expectLimitHolds(int points, int steps) {
  const Scene scene = swingingSheet(points);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  double largest = 0;
  for (int i = 0; i < steps; ++i) {
    solver.step(1);
    const Measures measures = measure(cloth, scene, solver.state());
    ASSERT_FALSE(measures.firstNonFinite) << "after step " << i;
    largest = std::max(largest, measures.maxStrain);
  }
  expectAtMost({"strain limit 10 %, soft swinging sheet",
                "largest stretch after any of " + std::to_string(steps) + " implicit steps of 1/60 s, " +
                    std::to_string(points) + "^2, newton_steps " + std::to_string(scene.solver.newtonSteps) +
                    ", cg_iterations " + std::to_string(scene.solver.cgIterations),
                "binary32", ""},
               largest, 0.101);
}

TEST(RowStrainLimitUnderImplicit, LongHoldsWithDefaults) { expectLimitHolds(64, 10'000); }

TEST(RowStrainLimitUnderImplicit, LongHoldsOnFinerSheetsWithDefaults) {
  expectLimitHolds(128, 600);
  expectLimitHolds(256, 300);
}

}  // namespace
}  // namespace clothsim::validation
