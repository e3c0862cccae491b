// Rows on whole sheets in motion: free fall, momentum, a scene turned and moved, and what must not move at
// all.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scene/pose.h"
#include "solver/cpu/cpu_solver.h"
#include "support/compared_scenes.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

using test::sheetScene;

// How far a free sheet has fallen after 1 s, less g t^2 / 2, relative to that.
template <class Real>
double freeFallError(Integrator integrator, int stepsPerSecond) {
  Scene scene = sheetScene(4);
  scene.cloths[0].ks.reset();
  scene.cloths[0].stiffnessReference = 1;
  scene.cloths[0].damping = 0;
  scene.gravity = {0, -9.81, 0};
  scene.solver.integrator = integrator;
  scene.solver.framesPerSec = 1;
  scene.solver.simulationSteps = stepsPerSecond;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(stepsPerSecond);
  return (1 - static_cast<double>(solver.position(5).y) - 4.905) / 4.905;
}

// Both Euler schemes fall by g t dt / 2 too far.
template <class Real>
void expectImplicitFreeFall(int stepsPerSecond, double tolerance) {
  expectNear({"free fall, 1 s", "relative error, implicit euler, dt = 1e-03 s", precisionOf<Real>, ""},
             freeFallError<Real>(Integrator::implicit, stepsPerSecond), 9.81 * 0.5 / stepsPerSecond / 4.905,
             tolerance);
}

template <class Real>
void expectFreeFall(int stepsPerSecond, double tolerance) {
  char step[30];
  std::snprintf(step, sizeof step, ", dt = %.0e s", 1.0 / stepsPerSecond);
  // Symplectic Euler falls by g t dt / 2 too far.
  for (const auto& [integrator, name, ahead] :
       {std::tuple{Integrator::verlet, "verlet", 0.0},
        {Integrator::euler, "symplectic euler", 9.81 * 0.5 / stepsPerSecond / 4.905}})
    expectNear({"free fall, 1 s", std::string("relative error, ") + name + step, precisionOf<Real>, ""},
               freeFallError<Real>(integrator, stepsPerSecond), ahead, tolerance);
}

TEST(RowFreeFall, IsExactUnderVerletAndHalfAStepAheadUnderEuler) {
  expectFreeFall<double>(1000, 1e-12);
  expectImplicitFreeFall<double>(1000, 1e-12);
  expectImplicitFreeFall<float>(1000, 2e-5);
  expectFreeFall<float>(10'000, 2e-5);
  expectFreeFall<float>(100'000, 1e-3);
}

template <class Real>
void expectMomentum(double tolerance) {
  Scene scene = sheetScene(20);
  scene.gravity = {0, 0, 0};
  scene.cloths[0].damping = 0;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.01, 0.01), speed(-1, 1);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d x = cloth.positions()[i] + Vec3d{jitter(random), jitter(random), jitter(random)};
    solver.setPosition(i, x.cast<Real>());
    solver.setVelocity(i, Vec3d{speed(random), speed(random), speed(random)}.cast<Real>());
  }
  Vec3d force{};
  double forces = 0, speeds = 0;
  for (const Vec3<Real>& f : solver.forces()) {
    force = force + f.template cast<double>();
    forces += length(f.template cast<double>());
  }
  const auto velocity = [&](std::uint32_t i) { return solver.velocity(i).template cast<double>(); };
  const auto total = [&] {
    Vec3d sum{};
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) sum = sum + velocity(i);
    return sum;
  };
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) speeds += length(velocity(i));
  const Vec3d before = total();
  solver.step(200);
  const std::string row = "momentum, no gravity";
  expectAtMost({row, "sum of forces over sum of their sizes", precisionOf<Real>, ""}, length(force) / forces,
               tolerance);
  expectAtMost({row, "change in 200 steps over sum of sizes", precisionOf<Real>, ""},
               length(total() - before) / speeds, tolerance);
}

TEST(RowMomentum, IsKeptWithoutGravity) {
  expectMomentum<double>(1e-13);
  expectMomentum<float>(1e-5);
}

// A sheet that falls over a sphere onto a slope, in the wind, with a strain limit. Without self-collision,
// whose contact sums are whole numbers along the axes.
Scene tumblingScene() {
  Scene scene = test::withLimiter(sheetScene(12));
  scene.cloths[0].pinned = {GridPoint{0, 0}};
  scene.cloths[0].damping = 0.5;
  scene.wind = Wind{.velocity = {1, 0.5, -2}, .gust = {}, .drag = 1.2, .lift = 0.4, .airDensity = 1.2};
  scene.airResistance = 1e-3;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.colliders = {Sphere{.origin = {0.6, 0.88, 0.5}, .radius = 0.1, .friction = 0.4},
                     Plane{.point = {0, 0.95, 0.9}, .normal = {0, 1, -0.3}, .friction = 0.1},
                     Box{.origin = {0.2, 0.8, 0.5}, .size = {0.2, 0.3, 0.25}, .friction = 0.2}};
  return scene;
}

// The same, turned by `rotation` [degrees] about the origin and then moved.
Scene turnedAndMoved(Scene scene, Vec3d rotation, Vec3d shift) {
  const Matrix3 turn = rotationMatrix(rotation);
  const Vec3d gridOrigin{0, 1, 0};  // of a horizontal cloth, about which its own rotation turns it
  scene.cloths[0].rotation = rotation;
  scene.cloths[0].position = rotate(turn, gridOrigin) + shift - gridOrigin;
  scene.gravity = rotate(turn, scene.gravity);
  scene.wind->velocity = rotate(turn, scene.wind->velocity);
  auto& sphere = std::get<Sphere>(scene.colliders[0]);
  auto& plane = std::get<Plane>(scene.colliders[1]);
  auto& box = std::get<Box>(scene.colliders[2]);
  sphere.origin = rotate(turn, sphere.origin) + shift;
  plane.point = rotate(turn, plane.point) + shift;
  plane.normal = rotate(turn, plane.normal);
  box.origin = rotate(turn, box.origin) + shift;
  box.rotation = rotation;
  return scene;
}

template <class Real>
double differenceAfterTurningBack(const Scene& scene) {
  constexpr int steps = 300;
  const Vec3d rotation{35, -70, 110}, shift{0.3, -0.8, 0.5};
  const Scene turned = turnedAndMoved(scene, rotation, shift);
  const Cloth cloth(scene), turnedCloth(turned);
  CpuSolver<Real> solver(cloth, scene), turnedSolver(turnedCloth, turned);
  solver.step(steps);
  turnedSolver.step(steps);
  const Matrix3 turn = rotationMatrix(rotation);
  double largest = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d back = rotateBack(turn, turnedSolver.position(i).template cast<double>() - shift);
    largest = std::max(largest, length(back - solver.position(i).template cast<double>()));
  }
  return largest;
}

// A contact adds dx / dt to the velocity, dx the difference of two positions as they are stored.
TEST(RowRotatedAndMovedScene, IsTheSameTurnedBack) {
  const std::string row = "rotated and moved scene, rotated back";
  expectAtMost({row, "largest difference after 300 steps", "double", "m"},
               differenceAfterTurningBack<double>(tumblingScene()), 1e-9);
  expectAtMost({row, "largest difference after 300 steps", "binary32", "m"},
               differenceAfterTurningBack<float>(tumblingScene()), 1e-5);
}

// Coordinates of the particles, all or the pinned ones, that differ by a bit from the start.
template <class Real>
int coordinatesMoved(const Scene& scene, int steps, bool onlyPins) {
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(steps);
  int moved = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    if (onlyPins && cloth.inverseMasses()[i] > 0) continue;
    const Vec3<Real> start = startPosition<Real>(cloth, i), now = solver.position(i);
    moved += (now.x != start.x) + (now.y != start.y) + (now.z != start.z);
  }
  return moved;
}

// Wind, colliders around a pin, a strain limit.
Scene pinnedScene() {
  Scene scene = test::withWind(test::withColliders(test::withLimiter(test::vertical(sheetScene(6)))));
  scene.colliders.emplace_back(Sphere{.origin = {0, 1, 0}, .radius = 0.1, .friction = 0.5});
  return scene;
}

template <class Real>
void expectPinsStay(int steps) {
  const std::string what = "coordinates of pins moved in " + std::to_string(steps) + " steps";
  expectAtMost({"pins; flat sheet without forces", what, precisionOf<Real>, ""},
               coordinatesMoved<Real>(pinnedScene(), steps, true), 0);
}

TEST(RowPins, AreUnmovedToTheBit) {
  expectPinsStay<float>(3000);
  expectPinsStay<double>(3000);
}

TEST(RowPins, LongAreUnmovedToTheBitIn100000Steps) {
  expectPinsStay<float>(100'000);
  expectPinsStay<double>(100'000);
}

// Jittered by its orientation, so its rest lengths are measured: they are kept in a table.
template <class Real>
void expectStill(int steps) {
  Scene scene = sheetScene(5);
  scene.cloths[0].orientation = Orientation::vertical;
  scene.gravity = {0, 0, 0};
  expectAtMost(
      {"pins; flat sheet without forces",
       "coordinates of the sheet moved in " + std::to_string(steps) + " steps, rest lengths measured",
       precisionOf<Real>, ""},
      coordinatesMoved<Real>(scene, steps, false), 0);
}

// Lattice lengths differ from measured ones in the last place, which the springs bring to rest at once.
template <class Real>
void expectStillButForRounding(int steps) {
  Scene scene = sheetScene(6);
  scene.gravity = {0, 0, 0};
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(steps);
  double largest = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    largest = std::max(largest, length(solver.position(i).template cast<double>() - cloth.positions()[i]));
  expectAtMost({"pins; flat sheet without forces",
                "way in " + std::to_string(steps) + " steps over spacing, nominal rest lengths",
                precisionOf<Real>, ""},
               largest / 0.2, 1e-6);
}

void expectFlatSheetStays(int steps) {
  expectStill<float>(steps);
  expectStill<double>(steps);
  expectStillButForRounding<float>(steps);
  expectStillButForRounding<double>(steps);
}

TEST(RowFlatSheetWithoutForces, StaysWhereItIs) { expectFlatSheetStays(10'000); }

TEST(RowFlatSheetWithoutForces, LongStaysWhereItIsFor100000Steps) { expectFlatSheetStays(100'000); }

}  // namespace
}  // namespace clothsim::validation
