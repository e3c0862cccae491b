// Layers of cloth that touch each other inside the implicit step (solver/surface.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "export/formats.h"
#include "measure/contact_report.h"
#include "measure/crossings.h"
#include "measure/measure.h"
#include "measure/surface_crossings.h"
#include "solver/cpu/cpu_solver.h"
#include "support/material_sheet.h"
#include "unit/validation/row.h"

namespace clothsim {
namespace {

Scene contactScene(int points, double size, const char* fabric) {
  Scene scene = test::materialSheet(points, points, size, size, *materialPreset(fabric));
  scene.solver.integrator = Integrator::implicit;
  scene.solver.simulationSteps = 2;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.solver.selfCollision = SelfCollision::contact;
  scene.colliders = {Plane{.point = {0, 0, 0}, .normal = {0, 1, 0}, .friction = 0.4}};
  chooseCounts(scene);
  return scene;
}

// A sheet that stands a little aslant above the floor, and falls into a heap.
Scene heap(const char* fabric) {
  Scene scene = contactScene(25, 0.4, fabric);
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].rotation = {0, 0, 4};
  scene.cloths[0].position = {0, 0.02, 0};
  return scene;
}

// Two sheets, the one above the other, at another angle.
Scene layers(const char* fabric) {
  Scene scene = contactScene(17, 0.3, fabric);
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[0].position = {0, -0.9995, 0};  // a horizontal sheet is made at height 1 m
  scene.cloths[1].position = {0.02, -0.9985, 0.01};
  scene.cloths[1].rotation = {0, 20, 0};
  return scene;
}

State after(const Scene& scene, int steps) {
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(steps);
  return solver.state();
}

TEST(SurfaceContact, LetsNothingCrossInAHeap) {
  if (!CrossingCounter::available()) FAIL() << "needs CGAL";
  for (const char* fabric : {"cotton", "silk"}) {
    const Scene scene = heap(fabric);
    const Shared<Cloth> cloth(Cloth{scene});
    const CrossingCounter counter(cloth);
    CpuSolver<float> solver(*cloth, scene);
    double longest = 0;
    for (int frame = 0; frame < 50; ++frame) {
      solver.step(2);
      ASSERT_EQ(counter.count(solver.state()).apart, 0u) << fabric << ", frame " << frame;
      longest = std::max(longest, measure(*cloth, scene, solver.state()).maxStrain);
    }
    EXPECT_GT(solver.contactCounts().pairs, 100u) << "it has fallen onto itself";
    EXPECT_EQ(solver.contactCounts().crowdedSteps, 0u);
    EXPECT_LT(longest, 0.3) << fabric;
  }
}

// Two sheets follow each other fast towards one that is held, and solving hardly begins. The guard cuts the
// first one's motion short; then the second one runs into it, which it would not without that.
TEST(SurfaceContact, StopsWhatFollowsASheetThatIsStopped) {
  if (!CrossingCounter::available()) FAIL() << "needs CGAL";
  constexpr int points = 7;
  Scene scene = contactScene(points, 0.1, "cotton");
  scene.colliders.clear();
  scene.gravity = {0, 0, 0};
  scene.solver.simulationSteps = scene.solver.newtonSteps = scene.solver.cgIterations = 1;
  scene.cloths.resize(3, scene.cloths[0]);
  for (int row = 0; row < points; ++row)
    for (int column = 0; column < points; ++column) scene.cloths[0].pinned.push_back(GridPoint{column, row});
  constexpr double way = 0.08;  // of a step [m]
  for (const double gap : {0.6 * way, 0.7 * way, 0.8 * way, 0.9 * way}) {
    scene.cloths[1].position.y = 0.003;
    scene.cloths[2].position.y = 0.003 + gap;
    const Shared<Cloth> cloth(Cloth{scene});
    CpuSolver<float> solver(*cloth, scene);
    State state = solver.state();
    for (std::size_t i = points * points; i < state.velocities.size(); ++i)
      state.velocities[i].y = static_cast<float>(-way * scene.solver.framesPerSec);
    solver.setState(state);
    const CrossingCounter counter(cloth);
    for (int step = 0; step < 3; ++step) {
      solver.step(1);
      EXPECT_EQ(counter.count(solver.state()).apart, 0u) << "gap " << gap << " m, step " << step;
    }
    EXPECT_GT(solver.contactCounts().shortened, 0u) << "motion was cut short";
  }
}

// A sheet that a breeze drapes over a ball: layers that fold, turn and slide together are not held back.
TEST(SurfaceContact, LetsADrapeFallAsItDoesWithoutContact) {
  if (!CrossingCounter::available()) FAIL() << "needs CGAL";
  for (const char* fabric : {"cotton", "silk"}) {
    Scene scene = contactScene(25, 1.7, fabric);
    scene.cloths[0].position = {-0.85, 0.62, -0.85};  // a horizontal sheet is made at height 1 m
    scene.colliders.insert(scene.colliders.begin(),
                           Sphere{.origin = {0, 1.05, 0}, .radius = 0.42, .friction = 0.35});
    scene.wind.emplace().velocity = {0.6, 0, -0.3};
    const Shared<Cloth> cloth(Cloth{scene});
    const CrossingCounter counter(cloth);
    CpuSolver<float> solver(*cloth, scene);
    double longest = 0;
    for (int frame = 0; frame < 50; ++frame) {
      solver.step(2);
      longest = std::max(longest, measure(*cloth, scene, solver.state()).maxStrain);
    }
    EXPECT_EQ(counter.count(solver.state()).apart, 0u) << fabric;
    EXPECT_GT(solver.contactCounts().pairs, 10u) << "its folds touch";
    EXPECT_LT(solver.contactCounts().shortened, 30u) << fabric;
    EXPECT_LT(longest, 0.1) << fabric;
  }
}

// Contact keeps parts on their sides, also on the wrong ones.
TEST(SurfaceContact, SaysWhatCrossesAtTheStart) {
  Scene scene = layers("cotton");
  const auto crossings = [&] {
    const Cloth cloth(scene);
    return crossingSides(cloth, scene, CpuSolver<float>(cloth, scene).state());
  };
  EXPECT_EQ(crossings(), 0u);
  scene.cloths[1].rotation = {30, 0, 0};  // through the lower one
  EXPECT_GT(crossings(), 17u);
  const Cloth cloth(scene);
  const State state = CpuSolver<float>(cloth, scene).state();
  if (!CrossingCounter::available()) FAIL() << "needs CGAL";
  EXPECT_GT(CrossingCounter(Shared<Cloth>(Cloth{scene})).count(state).apart, 17u) << "CGAL says so, too";
  ContactReport report;
  report.add(0, cloth, scene, state, 0, {});
  ASSERT_TRUE(report.failure());
  EXPECT_EQ(report.failure()->pairs, crossings());
  nlohmann::ordered_json json;
  report.write(json, cloth, scene, {});
  EXPECT_EQ(json["contact_sound"], false);
  EXPECT_EQ(json["contact"]["failed"]["condition"], "start_crossings");
  State torn = state;
  cutAlong(torn.cuts, cloth, 0, {1.5, -1}, {1.5, 40});
  report.add(1, cloth, scene, torn, 0, {});
  report.write(json, cloth, scene, {});
  EXPECT_EQ(json["contact_sound"], false) << "what was lost before a cut stays lost";
}

// A row of pins that is carried down through a pinned sheet.
TEST(SurfaceContact, SaysHowFarPinsLag) {
  Scene scene = contactScene(9, 0.2, "cotton");
  scene.colliders.clear();
  scene.gravity = {};
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[0].pinned = {GridSide::left, GridSide::right, GridSide::top, GridSide::bottom};
  scene.cloths[1].position = {0.003, 0.002, 0.004};
  scene.cloths[1].pinned = {GridSide::left, GridSide::right, GridSide::top, GridSide::bottom};
  // A horizontal sheet is made at height 1 m, and its centre is that of its pins.
  PinMotion down;
  down.keys = {{0, {}, {}}, {0.2, Vec3d{0.103, 0.982, 0.104}, {}}};
  scene.cloths[1].pinMotion = {down};
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(24);
  EXPECT_GT(solver.contactCounts().pinLag, 0.005) << "the pins of the lower one stop them";
  EXPECT_LT(solver.contactCounts().pinLag, 0.02);
}

TEST(SurfaceContact, KeepsLayersApartByTheThicknessOfTheFabric) {
  for (const char* fabric : {"cotton", "denim"}) {
    Scene scene = layers(fabric);
    scene.solver.simulationSteps = {8, true};
    chooseCounts(scene);
    ASSERT_EQ(scene.solver.simulationSteps, 4) << "steps that are solved";
    const State state = after(scene, 120);
    const double thickness = scene.cloths[0].material->thickness;
    const Cloth cloth(scene);
    // The middle of the upper sheet lies on the lower one, which lies on the floor.
    const auto upper = state.positions[cloth.pieces()[1].particle(8, 8)],
               lower = state.positions[cloth.pieces()[0].particle(8, 8)];
    EXPECT_NEAR((upper.y - lower.y) / thickness, 1, 0.1) << fabric;
  }
}

// How much speed a sheet loses in 1/20 s that slides over another one, past the corners and sides of its
// grid [m/s].
struct Slide {
  double friction, degrees;
  int stepsAFrame = 4;
  double tolerance = 1e-3;  // with which steps have iterations enough
  const char* fabric = "cotton";
  double speed = 0.5;
};
double lostSpeed(const Slide& slide) {
  Scene scene = layers(slide.fabric);
  scene.solver.simulationSteps = slide.stepsAFrame;
  chooseCounts(scene);
  scene.solver.selfFriction = slide.friction;
  scene.solver.tolerance = slide.tolerance;
  const bool isSolved = slide.tolerance < 0.01;
  if (isSolved) scene.solver.cgIterations = 60;
  scene.cloths[0].width = scene.cloths[0].height = 0.6;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 33;
  scene.cloths[0].pinned = {GridSide::left, GridSide::right, GridSide::top, GridSide::bottom};
  scene.cloths[0].position = {-0.1, 0.0002 - 1, -0.15};  // a horizontal sheet is made at height 1 m
  scene.cloths[1].position = {0.003, 0.0009 - 1, 0.002 + 5 * 0.01875};  // nowhere over a border
  scene.cloths[1].rotation = {0, slide.degrees, 0};
  scene.cloths[0].material->damping = scene.cloths[1].material->damping = 0;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(4 * static_cast<std::uint32_t>(slide.stepsAFrame));  // it settles
  State state = solver.state();
  const Piece& upper = cloth.pieces()[1];
  const auto speed = static_cast<float>(slide.speed);
  for (std::uint32_t i = upper.firstParticle; i < cloth.particleCount(); ++i) state.velocities[i].x = speed;
  solver.setState(state);
  solver.step(3 * static_cast<std::uint32_t>(slide.stepsAFrame));
  const State slid = solver.state();
  double sum = 0;
  for (std::uint32_t i = upper.firstParticle; i < cloth.particleCount(); ++i) sum += slid.velocities[i].x;
  if (isSolved) {
    EXPECT_EQ(solver.convergenceCounts().unconvergedSteps, 0u);
  }
  return speed - sum / upper.particleCount();
}

// Friction begins a step as it ended the last one, also after a state was saved.
TEST(SurfaceContact, KeepsLayersWhereTheyStick) {
  Scene scene = layers("silk");
  scene.solver.simulationSteps = 4;
  std::get<Plane>(scene.colliders[0]).friction = 3;
  const double angle = std::atan(scene.cloths[0].material->friction) - 0.05;
  scene.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0};
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene), second(cloth, scene);
  solver.step(4 * 20);
  const State then = solver.state();
  EXPECT_FALSE(then.pairSlips.empty());
  second.setState(parseStateFile(formatStateFile(then), cloth.particleCount(), "layers.state"));
  for (CpuSolver<float>* own : {&solver, &second}) own->step(4 * 20);
  const State now = solver.state();
  EXPECT_EQ(stateHash(second.state()), stateHash(now));
  for (std::size_t i = 0; i < now.positions.size(); ++i)
    EXPECT_NEAR(length(vectorOf(now.positions[i]) - vectorOf(then.positions[i])), 0, 1e-5) << i;
}

// Corners and sides that a layer slides past are no bumps, also where it slides half a cell in a step, or at
// the usual tolerance.
TEST(SurfaceContact, RubsLayersOnEachOtherByCoulombsLaw) {
  EXPECT_NEAR(lostSpeed({0, 7}), 0, 1e-4);
  struct Case {
    Slide slide;
    double mostError;
  };
  for (const auto& [slide, mostError] : {Case{{0.3, 0}, 0.02},
                                         {{0.1, 7}, 0.02},
                                         {{0.3, 7}, 0.02},
                                         {{0.3, 20}, 0.02},
                                         {{0.3, 7, 1}, 0.10},
                                         {{0.3, 7, 4, 1e-2}, 0.12},
                                         {{0.3, 20, 4, 1e-2}, 0.12}}) {
    const double byCoulomb = slide.friction * 9.81 / 20;
    EXPECT_NEAR(lostSpeed(slide) / byCoulomb, 1, mostError)
        << slide.friction << ", " << slide.degrees << " degrees, " << slide.stepsAFrame
        << " steps a frame, tolerance " << slide.tolerance;
  }
}

// At the tolerance and with the iterations that a user gets.
TEST(RowLayersThatRub, LongLoseSpeedByCoulombsLaw) {
  for (const int stepsAFrame : {4, 8})
    for (const double speed : {0.25, 0.5, 1.5})
      for (const char* fabric : {"silk", "cotton", "denim", "wool"})
        for (const double degrees : {0, 7, 20, 33, 45}) {
          std::ostringstream what;
          what << "speed lost, " << fabric << ", " << degrees << " degrees, " << speed << " m/s, "
               << stepsAFrame << " steps a frame";
          const double lost = lostSpeed({0.3, degrees, stepsAFrame, 1e-2, fabric, speed});
          validation::expectNear({"layers that rub", what.str(), validation::precisionOf<float>, ""},
                                 lost / (0.3 * 9.81 / 20), 1, 0.02);
        }
}

}  // namespace
}  // namespace clothsim
