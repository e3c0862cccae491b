#include "solver/cpu/cpu_solver.h"

#include <gtest/gtest.h>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <cmath>
#include <cstring>
#include <numbers>

#include "cloth/material.h"
#include "core/thread_team.h"
#include "measure/measure.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/force_laws.h"
#include "support/compared_scenes.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

using test::sheetScene;
using test::springScene;

Scene busyScene(int n) {
  return test::withWind(test::withColliders(test::withLimiter(test::vertical(sheetScene(n)))));
}

State stepped(const Scene& scene, int steps, bool fused = true) {
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene, fused);
  solver.step(steps);
  return solver.state();
}

// Of a grid that has moved: the springs of each particle by their law, one after the other.
std::vector<Vec3f> springForcesOneByOne(const Cloth& cloth, const Scene& scene, const CpuState<float>& state,
                                        double time) {
  const auto step = makeStepParams<float>(scene, cloth, 0, time);
  const int columns = scene.cloths[0].numWidthPoints, rows = scene.cloths[0].numHeightPoints;
  const auto isInside = [&](int column, int row) {
    return column >= 0 && column < columns && row >= 0 && row < rows;
  };
  const auto isBorder = [](int place, int count) { return place == 0 || place == count - 1; };
  const std::vector<float> rests = measureRestLengths<float>(cloth);  // by slot, then by owner
  std::vector<Vec3f> forces;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto at = [&](int c, int r) { return cpu::at(state.positions, std::ptrdiff_t{r} * columns + c); };
      Vec3f sum{};
      for (const IncidentSpring& spring : incidentSprings) {
        if (!isInside(column + spring.columns, row + spring.rows)) continue;
        if ((step.enabledSlots >> spring.slot & 1u) == 0) continue;
        const bool isHalved =
            step.hasMaterial != 0 && ((spring.slot == toLeft && isBorder(row, rows)) ||
                                      (spring.slot == toUpper && isBorder(column, columns)));
        const auto& params = step.springs[spring.slot];
        const int owner =
            (spring.owned ? 0 : spring.rows * columns + spring.columns) + row * columns + column;
        const float rest = step.useRestLengthTable == 0
                               ? params.restLength
                               : rests[spring.slot * cloth.particleCount() + static_cast<std::size_t>(owner)];
        sum = sum + cpu::springForce(at(column, row), at(column + spring.columns, row + spring.rows),
                                     isHalved ? 0.5f * params.stiffness : params.stiffness, rest);
      }
      forces.push_back(sum);
    }
  return forces;
}

TEST(CpuSolver, AddsTheSpringsOfRowsOfAnyLengthAsOneByOne) {
  Material limp = *materialPreset("cotton");
  limp.bend = 0;
  for (const int rows : {2, 3, 6})
    for (const int columns : {2, 15, 16, 17, 18, 19, 31, 32, 33, 34, 35, 50})
      for (const bool isFabric : {false, true}) {
        Scene scene = test::vertical(
            isFabric ? test::materialSheet(columns, rows, 0.01 * columns, 0.01 * rows, limp) : sheetScene(2));
        scene.cloths[0].numWidthPoints = columns;
        scene.cloths[0].numHeightPoints = rows;
        scene.cloths[0].pinned = {GridPoint{0, 0}};
        const Cloth cloth(scene);
        CpuSolver<float> solver(cloth, scene);
        solver.step(3);
        const std::vector<Vec3f> expected = springForcesOneByOne(cloth, scene, solver.particles(), 0);
        EXPECT_EQ(solver.forces(), expected) << columns << "x" << rows << (isFabric ? ", fabric" : "");
      }
}

TEST(CpuSolver, GivesTheSameBitsAtAnyNumberOfThreads) {
  const Scene scene = busyScene(92);  // enough particles for threads to be used
  const int usual = ThreadTeam::shared().threads();
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 7}) {
    ThreadTeam::setSharedThreads(threads);
    hashes.push_back(stateHash(stepped(scene, 60)));
  }
  ThreadTeam::setSharedThreads(usual);
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

// Each of them too small for a second thread.
TEST(CpuSolver, SharesSeveralClothsByAnyNumberOfThreads) {
  Scene scene = test::twoCloths(test::twoCloths(test::withLimiter(test::vertical(test::sheetScene(31)))));
  scene.solver.strainLimit = 0.001;
  const int usual = ThreadTeam::shared().threads();
  for (const Integrator integrator : {Integrator::euler, Integrator::implicit}) {
    scene.solver.integrator = integrator;
    const int steps = integrator == Integrator::implicit ? 2 : 40;
    ThreadTeam::setSharedThreads(1);
    const std::uint64_t alone = stateHash(stepped(scene, steps));
    EXPECT_EQ(stateHash(stepped(scene, steps, false)), alone) << "pass by pass";
    for (const int threads : {2, 3, 5}) {
      ThreadTeam::setSharedThreads(threads);
      EXPECT_EQ(stateHash(stepped(scene, steps)), alone) << threads << " threads";
    }
  }
  ThreadTeam::setSharedThreads(usual);
}

TEST(CpuSolver, GivesTheSameBitsFusedAndPassByPass) {
  const Scene scene = busyScene(20);
  EXPECT_EQ(stateHash(stepped(scene, 300, true)), stateHash(stepped(scene, 300, false)));
}

TEST(CpuSolver, GoesOnFromASavedStateAsIfNothingHadHappened) {
  const Scene scene = busyScene(20);
  const Cloth cloth(scene);
  CpuSolver<float> whole(cloth, scene), first(cloth, scene), second(cloth, scene);
  whole.step(200);
  first.step(77);
  second.setState(first.state());
  second.step(123);
  EXPECT_EQ(stateHash(whole.state()), stateHash(second.state()));
}

TEST(CpuSolver, HoldsNoMinusZeroAndNoTinyNumberInItsState) {
  const State state = stepped(busyScene(20), 300);
  for (const auto* array : {&state.positions, &state.velocities})
    for (const Particle4& p : *array)
      for (const float x : {p.x, p.y, p.z})
        EXPECT_TRUE((x == 0 && !std::signbit(x)) || std::abs(x) >= 0x1p-40f) << x;
}

#if defined(__SSE2__)
TEST(CpuSolver, GivesTheSameBitsWhereTheProcessorFlushesDenormals) {
  const Scene scene = busyScene(20);  // small: on this thread alone
  const std::uint64_t usual = stateHash(stepped(scene, 300));
  const unsigned mode = _mm_getcsr();
  _mm_setcsr(mode | 0x8040);  // flush to zero, denormals are zero
  const std::uint64_t flushed = stateHash(stepped(scene, 300));
  _mm_setcsr(mode);
  EXPECT_EQ(flushed, usual);
}
#endif

TEST(StrainLimit, HoldsASpringThatThePassCanReach) {
  Scene scene = springScene(1, 10, 1, 1e-3, Integrator::euler);
  scene.solver.strainLimit = 0.1;
  scene.gravity = {0, -9.81, 0};  // would stretch it by 0.98
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  for (int i = 0; i < 3000; ++i) {
    solver.step(1);
    EXPECT_LE(-solver.position(1).y, 1.1 + 1e-12);
  }
  EXPECT_GT(-solver.position(1).y, 1.09) << "and lets it reach the limit";
}

TEST(StrainLimit, MovesBothFreeEndsByHalfTheExcess) {
  Scene scene = springScene(1, 1e-9, 1, 1e-3, Integrator::euler);
  scene.cloths[0].pinned.clear();
  scene.solver.strainLimit = 0.1;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.setPosition(1, {0, -1.5, 0});
  solver.step(1);
  EXPECT_NEAR(solver.position(0).y, -0.2, 1e-9);
  EXPECT_NEAR(solver.position(1).y, -1.3, 1e-9);
  EXPECT_NEAR(solver.velocity(1).y, 0.2 / 1e-3, 1e-5) << "a position pass adds dx / h to the velocity";
}

TEST(StrainLimit, ColoursCoverEverySpringOnceAndShareNoParticle) {
  for (const auto& [columns, rows] : {std::pair{9, 7}, {4, 4}, {3, 10}, {2, 2}, {1, 6}}) {
    Scene scene = sheetScene(2);
    scene.cloths[0].numWidthPoints = columns;
    scene.cloths[0].numHeightPoints = rows;
    const Cloth cloth(scene);
    const Piece& piece = cloth.pieces()[0];
    std::vector<int> visits(6 * cloth.particleCount());
    for (const LimitColor& color : makeLimitColors(piece)) {
      std::vector<int> touched(cloth.particleCount());
      for (std::uint32_t j = 0; j < ownerCount(color.firstRow, color.rowStep, color.rowRun, color.endRow);
           ++j) {
        for (std::uint32_t i = 0;
             i < ownerCount(color.firstColumn, color.columnStep, color.columnRun, color.endColumn); ++i) {
          const int column = static_cast<int>(color.firstColumn + color.columnStep * (i / color.columnRun) +
                                              i % color.columnRun);
          const int row =
              static_cast<int>(color.firstRow + color.rowStep * (j / color.rowRun) + j % color.rowRun);
          const SpringOffset& offset = springOffsets[color.slot];
          ASSERT_TRUE(piece.contains(column, row) &&
                      piece.contains(column + offset.columns, row + offset.rows));
          ++visits[6 * piece.particle(column, row) + color.slot];
          EXPECT_EQ(++touched[piece.particle(column, row)], 1);
          EXPECT_EQ(++touched[piece.particle(column + offset.columns, row + offset.rows)], 1);
        }
      }
    }
    std::uint64_t total = 0;
    for (const Spring& spring : cloth.springs())
      EXPECT_EQ(visits[spring.number], 1) << columns << "x" << rows;
    for (const int visit : visits) total += static_cast<std::uint64_t>(visit);
    EXPECT_EQ(total, cloth.springCount());
  }
}

// One free particle at `x` with velocity `v` that meets a collider for one step of 0.01 s.
Vec3d afterOneStep(const Collider& collider, Vec3d x, Vec3d v) {
  Scene scene = springScene(1, 1e-9, 1, 0.01, Integrator::euler);
  scene.cloths[0].pinned.clear();
  scene.colliders = {collider};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.setPosition(0, {0, 50, 0});
  solver.setPosition(1, x);
  solver.setVelocity(1, v);
  solver.step(1);
  return solver.position(1);
}

TEST(Sphere, PutsAParticleInsideBetweenWhereItWasAndTheSurfaceByItsFriction) {
  const Sphere sphere{.origin = {0, 0, 0}, .radius = 1, .friction = 0, .motion = std::nullopt};
  const Vec3d start{0, 1.005, 0}, velocity{0, -10, 0};  // to (0, 0.905, 0): inside
  EXPECT_NEAR(afterOneStep(sphere, start, velocity).y, 1, 1e-9);
  Sphere sticky = sphere;
  sticky.friction = 1;
  EXPECT_NEAR(afterOneStep(sticky, start, velocity).y, 1.005, 1e-9);
  Sphere rough = sphere;
  rough.friction = 0.3;
  EXPECT_NEAR(afterOneStep(rough, start, velocity).y, 1.005 + 0.7 * (1 - 1.005), 1e-9);
}

TEST(Plane, PutsAParticleThatCrossedBackToTheSideItCameFrom) {
  const Plane plane{.point = {0, 2, 0}, .normal = {0, 3, 0}, .friction = 0, .motion = std::nullopt};
  EXPECT_NEAR(afterOneStep(plane, {0.3, 2.01, 0}, {1, -10, 0}).y, 2.0001, 1e-9);
  EXPECT_NEAR(afterOneStep(plane, {0.3, 1.99, 0}, {1, 10, 0}).y, 1.9999, 1e-9);
  EXPECT_NEAR(afterOneStep(plane, {0.3, 2.01, 0}, {1, -10, 0}).x, 0.31, 1e-9) << "no friction: it slides on";
  Plane sticky = plane;
  sticky.friction = 1;
  EXPECT_NEAR(afterOneStep(sticky, {0.3, 2.01, 0}, {1, -10, 0}).x, 0.3, 1e-9);
}

TEST(Plane, IgnoresAParticleThatStaysOnItsSide) {
  const Plane plane{.point = {0, 2, 0}, .normal = {0, 1, 0}, .friction = 1, .motion = std::nullopt};
  EXPECT_NEAR(afterOneStep(plane, {0, 1.5, 0}, {0, 1, 0}).y, 1.51, 1e-9);
}

TEST(MovingSphere, CarriesAParticleThatSticksToItAlongAndAround) {
  Motion motion;
  motion.keys = {{0, {0, 0, 0}, {0, 0, 0}}, {0.01, {0.02, 0, 0}, {0, 0, 90}}};
  const Sphere sphere{.origin = {0, 0, 0}, .radius = 1, .friction = 1, .motion = motion};
  const Vec3d x = afterOneStep(sphere, {1, 0, 0}, {0, 0, 0});
  EXPECT_NEAR(x.x, 0.02, 1e-9);
  EXPECT_NEAR(x.y, 1, 1e-9);
}

TEST(Integrators, CanBeSwitchedBackAndForthWithoutLosingTheVelocity) {
  Scene scene = sheetScene(10);
  scene.cloths[0].ks.reset();
  scene.cloths[0].stiffnessReference = 10;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(50);
  const Vec3d half = solver.velocity(55);
  Scene asEuler = scene;
  asEuler.solver.integrator = Integrator::euler;
  solver.configure(asEuler);
  EXPECT_EQ(solver.state().integrator, Integrator::euler);
  const Vec3d whole = solver.velocity(55);
  EXPECT_NEAR(whole.y - half.y, -0.5 * 9.8 * stepLength(scene.solver), 1e-9) << "v(n) = v(n-1/2) + a h / 2";
  solver.configure(scene);
  (void)solver.state();
  EXPECT_NEAR(solver.velocity(55).y, half.y, 1e-12);
}

TEST(Integrators, KeepTheVelocityWhenTheStepChanges) {
  Scene scene = sheetScene(10);
  scene.cloths[0].pinned.clear();
  scene.cloths[0].damping = 0;
  Scene longer = scene;
  longer.solver.simulationSteps = 4;
  const Cloth cloth(scene);
  CpuSolver<double> live(cloth, scene);
  live.step(50);
  const State saved = live.state();
  Scene synchronous = scene;
  synchronous.solver.integrator = longer.solver.integrator = Integrator::euler;
  const auto velocityOf = [](CpuSolver<double>& solver) {
    (void)solver.state();  // converts
    return solver.velocity(55).y;
  };
  live.configure(synchronous);
  const double velocity = velocityOf(live);
  live.setState(saved);
  live.configure(longer);
  EXPECT_NEAR(velocityOf(live), velocity, 1e-7) << "while it goes on";
  CpuSolver<double> loaded(cloth, longer);
  loaded.setState(saved);
  EXPECT_NEAR(velocityOf(loaded), velocity, 1e-7) << "from a state";
}

TEST(Integrators, OfKsScenesBeginAsCs184DoesAndOthersSynchronously) {
  Scene scene = sheetScene(5);
  EXPECT_EQ(stepped(scene, 0).velocities[7].y, 0);
  scene.cloths[0].ks.reset();
  scene.cloths[0].stiffnessReference = 10;
  EXPECT_NEAR(static_cast<double>(stepped(scene, 0).velocities[7].y), 0.5 * 9.8 / 2700, 1e-9);
}

TEST(AirResistance, IsQuadraticInTheSpeedOfAParticle) {
  Scene scene = sheetScene(3);
  scene.airResistance = 0.25;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.setVelocity(4, {0, 3, 4});
  const Vec3d force = solver.forces()[4];
  EXPECT_NEAR(force.y, -0.25 * 5 * 3, 1e-9);
  EXPECT_NEAR(force.z, -0.25 * 5 * 4, 1e-9);
}

// Sum of the forces on a sheet at rest, turned about x by `degrees`, in the scene's wind.
Vec3d windOnPlate(const Wind& wind, double degrees, int points) {
  Scene scene = sheetScene(points);
  scene.cloths[0].rotation = {degrees, 0, 0};
  scene.cloths[0].enableStructural = scene.cloths[0].enableShearing = scene.cloths[0].enableBending = false;
  scene.wind = wind;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  Vec3d sum{};
  for (const Vec3d& force : solver.forces()) sum = sum + force;
  return sum;
}

TEST(Wind, LiftsAcrossTheWindByTheSineOfTwiceTheAngleOfAttack) {
  const Wind wind{.velocity = {0, 0, -3}, .gust = {}, .drag = 0, .lift = 0.8, .airDensity = 1.2};
  const double angle = 25 * std::numbers::pi / 180;  // between the sheet and the wind
  const Vec3d force = windOnPlate(wind, 25, 6);
  EXPECT_NEAR(dot(force, wind.velocity), 0, 1e-9) << "lift does no work on the wind";
  EXPECT_NEAR(std::abs(force.y), 0.5 * 1.2 * 0.8 * 9 * 0.5 * std::sin(2 * angle), 1e-6);
}

TEST(Gusts, HaveTheStrengthOfTheSceneAndRepeatBySeed) {
  Wind wind{.velocity = {4, 0, 0}, .gust = {.strength = 1.5, .frequency = 1, .seed = 9}};
  double sum = 0, squares = 0;
  constexpr int samples = 200000;
  for (int i = 0; i < samples; ++i) {
    const double gust = airVelocity(wind, i * 0.01).x - 4;
    sum += gust;
    squares += gust * gust;
  }
  EXPECT_NEAR(sum / samples, 0, 0.02);
  EXPECT_NEAR(std::sqrt(squares / samples), 1.5, 0.05);
  EXPECT_EQ(airVelocity(wind, 1.23), airVelocity(wind, 1.23));
  Wind other = wind;
  other.gust.seed = 10;
  EXPECT_NE(airVelocity(wind, 1.23), airVelocity(other, 1.23));
}

TEST(Measure, FindsStretchDepthEnergyAndTheFirstBrokenParticle) {
  Scene scene = springScene(1, 1, 2, 1e-3, Integrator::euler);
  scene.colliders = {Sphere{.origin = {0, -1.5, 0}, .radius = 0.5, .friction = 0, .motion = std::nullopt}};
  const Cloth cloth(scene);
  State state = initialState(cloth, scene);
  state.positions[1].y = -1.25f;
  state.velocities[1].y = 3;
  const Measures measures = measure(cloth, scene, state);
  EXPECT_NEAR(measures.maxStrain, 0.25, 1e-6);
  EXPECT_NEAR(measures.maxPenetration, 0.25, 1e-6);
  EXPECT_NEAR(measures.kineticEnergy, 9, 1e-5);
  EXPECT_NEAR(measures.minY, -1.25, 1e-6);
  EXPECT_FALSE(measures.firstNonFinite.has_value());
  state.velocities[1].z = std::nanf("");
  EXPECT_EQ(measure(cloth, scene, state).firstNonFinite, 1u);
}

}  // namespace
}  // namespace clothsim
