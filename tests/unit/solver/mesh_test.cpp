// Physics of cloth made of a mesh, against formulas for the sheet that it stands for.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cloth/material.h"
#include "measure/crossings.h"
#include "measure/energies.h"
#include "measure/measure.h"
#include "solver/cpu/cpu_solver.h"
#include "support/mesh_sheet.h"

namespace clothsim {
namespace {

Scene materialScene(const test::MeshSheet& sheet, const Material& material) {
  Scene scene = test::meshScene(sheet);
  scene.cloths[0].ks.reset();
  scene.cloths[0].material = material;
  scene.solver.integrator = Integrator::euler;
  return scene;
}

std::vector<Vec3d> positionsOf(const Cloth& cloth) {
  return {cloth.positions().begin(), cloth.positions().end()};
}

double springEnergy(const Cloth& cloth, const std::vector<Vec3d>& x) {
  double energy = 0;
  for (const Spring& spring : cloth.springs()) {
    const double stretch = length(x[spring.a] - x[spring.b]) - spring.restLength;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

double bendingEnergy(const Cloth& cloth, const std::vector<Vec3d>& x) {
  double energy = 0;
  for (const Hinge& hinge : cloth.lists().hinges) {
    Vec3d sum;
    for (std::size_t k = 0; k < 4; ++k) sum = sum + hinge.coefficients[k] * x[hinge.corners[k]];
    energy += 0.5 * dot(sum, sum);
  }
  return energy;
}

double areaOf(const test::MeshSheet& sheet) {
  return (sheet.columns - 1) * (sheet.rows - 1) * std::sqrt(0.75) * sheet.edge * sheet.edge;
}

template <class Real>
void expectNoForceAtRest(const Scene& scene) {
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  for (const Vec3<Real>& f : solver.forces()) EXPECT_EQ(f, Vec3<Real>{});
}

TEST(MeshAtRest, FeelsNoForceAtAll) {
  Scene scene = test::meshScene({.disorder = 0.25});
  scene.cloths[0].rotation = {20, 50, -10};
  scene.cloths[0].position = {0.3, -0.2, 5};
  scene.cloths[0].scale = 1.7;
  expectNoForceAtRest<float>(scene);
  expectNoForceAtRest<double>(scene);
}

// In its plane by e along x, and by -e/3 across: 1/2 Y e^2 an area at Poisson's ratio 1/3.
double stretchedModulus(const test::MeshSheet& sheet, bool alongX) {
  const Cloth cloth(materialScene(sheet, Material{.stretch = 300}));
  constexpr double e = 1e-5;
  std::vector<Vec3d> x = positionsOf(cloth);
  for (Vec3d& p : x) p = {p.x * (1 + (alongX ? e : -e / 3)), p.y * (1 + (alongX ? -e / 3 : e)), p.z};
  return springEnergy(cloth, x) / areaOf(sheet) / (0.5 * e * e);
}

TEST(MeshMaterial, HasItsYoungsModulusInEveryDirection) {
  for (const bool alongX : {true, false}) {
    EXPECT_NEAR(stretchedModulus({.columns = 12, .rows = 13}, alongX), 300, 0.1);
    EXPECT_NEAR(stretchedModulus({.columns = 24, .rows = 25, .disorder = 0.2}, alongX), 300, 5)
        << "in disorder";
  }
}

// Rolled onto a cylinder: 1/2 B / r^2 an area, less what the border's missing hinges leave out.
double rolledRigidity(const test::MeshSheet& sheet, bool alongX) {
  const Cloth cloth(materialScene(sheet, Material{.bend = 1e-4}));
  constexpr double r = 2;
  std::vector<Vec3d> x = positionsOf(cloth);
  for (Vec3d& p : x)
    p = alongX ? Vec3d{r * std::sin(p.x / r), p.y, r * (1 - std::cos(p.x / r))}
               : Vec3d{p.x, r * std::sin(p.y / r), r * (1 - std::cos(p.y / r))};
  return bendingEnergy(cloth, x) / areaOf(sheet) / (0.5 / (r * r));
}

TEST(MeshMaterial, BendsWithItsRigidityInEveryDirection) {
  for (const bool alongX : {true, false}) {
    EXPECT_NEAR(rolledRigidity({.columns = 60, .rows = 70, .edge = 0.02}, alongX), 1e-4, 0.02e-4);
    EXPECT_NEAR(rolledRigidity({.columns = 60, .rows = 70, .edge = 0.02, .disorder = 0.15}, alongX), 1e-4,
                0.06e-4)
        << "in disorder";
  }
}

TEST(MeshMaterial, DoesNotFeelThatItIsFlatAndTurned) {
  Scene scene = materialScene({.disorder = 0.2}, Material{.bend = 1e-3});
  scene.cloths[0].rotation = {20, 50, -10};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  for (const Vec3d& f : solver.forces()) EXPECT_LT(length(f), 1e-11);
}

TEST(MeshForces, AreTheSlopeOfTheEnergyAndSumToZero) {
  const Scene scene =
      materialScene({.columns = 6, .rows = 7, .disorder = 0.2}, Material{.stretch = 50, .bend = 1e-3});
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-0.01, 0.01);
  std::vector<Vec3d> x = positionsOf(cloth);
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    x[i] = x[i] + Vec3d{uniform(engine), uniform(engine), uniform(engine)};
    solver.setPosition(i, x[i]);
  }
  const auto energy = [&] { return springEnergy(cloth, x) + bendingEnergy(cloth, x); };
  Vec3d sum;
  const std::vector<Vec3d> forces = solver.forces();
  constexpr double h = 1e-6;
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    sum = sum + forces[i];
    double* const coordinates[] = {&x[i].x, &x[i].y, &x[i].z};
    const double force[] = {forces[i].x, forces[i].y, forces[i].z};
    for (int k = 0; k < 3; ++k) {
      const double before = *coordinates[k];
      *coordinates[k] = before + h;
      const double up = energy();
      *coordinates[k] = before - h;
      EXPECT_NEAR(force[k], -(up - energy()) / (2 * h), 1e-6);
      *coordinates[k] = before;
    }
  }
  EXPECT_LT(length(sum), 1e-12);
}

TEST(MeshOfEqualTriangles, RestsInsideWhereItIsStretchedAlikeEverywhere) {
  const Scene scene = test::meshScene();
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d p = cloth.positions()[i];
    solver.setPosition(i, {1.03 * p.x + 0.02 * p.y, 0.98 * p.y, 0.1 * p.x});
  }
  const std::vector<Vec3d> forces = solver.forces();
  for (int row = 2; row < 12; ++row)
    for (int column = 2; column < 10; ++column)
      EXPECT_LT(length(forces[static_cast<std::size_t>(12 * row + column)]), 2e-3) << row << ", " << column;
  EXPECT_GT(length(forces[0]), 0.1) << "the border pulls";
}

TEST(MeshInTheWind, FeelsThePressureOnItsAreaWhateverItsTriangles) {
  const test::MeshSheet sheet{.disorder = 0.25};
  Scene scene = test::meshScene(sheet);
  scene.cloths[0].rotation = {0, 35, 0};
  scene.wind = Wind{.velocity = {0, 0, 3}, .gust = {}, .drag = 1.4, .lift = 0, .airDensity = 1.1};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  Vec3d sum;
  for (const Vec3d& f : solver.forces()) sum = sum + f;
  const double angle = 35 * std::acos(-1) / 180, through = 3 * std::cos(angle);
  const double pressure = 0.5 * 1.1 * 1.4 * through * through * areaOf(sheet);
  EXPECT_NEAR(sum.x, pressure * std::sin(angle), 1e-5 * pressure);
  EXPECT_NEAR(sum.z, pressure * std::cos(angle), 1e-5 * pressure);
}

TEST(MeshUnderAutomaticSteps, StaysStable) {
  Scene scene = materialScene({.disorder = 0.3}, *materialPreset("jersey"));
  scene.gravity = {0, 0, 0};
  scene.cloths[0].material->damping = 0;
  scene.solver.simulationSteps.automatic = true;
  chooseCounts(scene);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    solver.setVelocity(i, {uniform(engine), uniform(engine), uniform(engine)});
  const double before = measure(cloth, scene, solver.state()).kineticEnergy;
  solver.step(3000);
  EXPECT_LT(measure(cloth, scene, solver.state()).kineticEnergy, 2 * before);
}

// Hung from its upper edge until it comes to rest, with and without limiter.
double strainHanging(bool limited) {
  Scene scene = test::meshScene();
  scene.cloths[0].ks = 1;
  scene.cloths[0].damping = 1;
  scene.cloths[0].pinned = {GroupPin{"top"}};
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 20;
  if (limited) scene.solver.strainLimit = 0.1;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(600);
  return measure(cloth, scene, solver.state()).maxStrain;
}

TEST(MeshStrainLimit, HoldsBackWhatSpringsDoNot) {
  EXPECT_GT(strainHanging(false), 0.5);
  EXPECT_LT(strainHanging(true), 0.2);
}

TEST(MeshSelfCollision, KeepsLayersOfOneMeshApart) {
  Scene scene = test::meshScene({.columns = 10, .rows = 10, .layers = 3});
  scene.cloths[0].rotation = {-90, 0, 0};  // layers above each other
  scene.cloths[0].ks = 100;
  scene.cloths[0].pinned = {VertexPin{0}, VertexPin{9}, VertexPin{90}, VertexPin{99}};  // of the lowest
  scene.solver.selfCollision = SelfCollision::robust;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 20;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  for (int frame = 0; frame < 40; ++frame) {
    solver.step(20);
    const std::uint64_t crossings =
        CrossingCounter::available() ? CrossingCounter(cloth).count(solver.state()).apart : 0;
    EXPECT_EQ(crossings, 0u) << frame;
  }
  double lower = 0, upper = 0;
  for (std::uint32_t i = 0; i < 100; ++i) {
    lower += static_cast<double>(solver.position(i).y) / 100;
    upper += static_cast<double>(solver.position(200 + i).y) / 100;
  }
  EXPECT_GT(upper, lower + 0.04) << "the upper one lies on the others";
}

TEST(MeshSelfCollision, LeavesAMeshAtRestAlone) {
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    Scene scene = test::meshScene({.disorder = 0.25});
    scene.cloths[0].thickness = 0.1;  // more than its edges
    scene.solver.selfCollision = mode;
    scene.gravity = {0, 0, 0};
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(20);
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
      EXPECT_LT(length(solver.position(i).cast<double>() - cloth.positions()[i]), 1e-6);
  }
}

TEST(MeshInAHand, FollowsItWithWhatLiesNearAtRest) {
  Scene scene = test::meshScene();
  scene.gravity = {0, 0, 0};
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const auto read = [&](std::uint32_t first, std::uint32_t count) { return solver.positions(first, count); };
  Interaction interaction;
  interaction.grab = makeGrabSpring(cloth, 80, 1e4, 0.12, read);
  const Vec3d from = interaction.grab->from;
  moveTo(*interaction.grab, from + Vec3d{0, 0, 0.3}, 0, 100);
  solver.setInteraction(interaction);
  solver.step(400);
  EXPECT_NEAR(static_cast<double>(solver.position(80).z), 0.3, 0.05);
  EXPECT_GT(static_cast<double>(solver.position(81).z), 0.2) << "a neighbour comes along";
  EXPECT_EQ((*interaction.grab->points)[80 - interaction.grab->firstColumn].weight, 1.0f);
}

TEST(ParticlesLetGo, WeighWhatTheyDidBeforeTheyWerePinned) {
  Scene piece;
  piece.cloths[0].numWidthPoints = piece.cloths[0].numHeightPoints = 5;
  piece.cloths[0].material = Material{};
  for (const Scene& scene : {test::meshScene(), piece}) {
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    for (const std::uint32_t particle : {0u, 2u, 12u}) {  // of the grid: a corner, on a border, inside
      const float before = solver.positions(particle, 1)[0].w;
      solver.setPin(particle, true);
      EXPECT_EQ(solver.positions(particle, 1)[0].w, 0.0f);
      solver.setPin(particle, false);
      EXPECT_EQ(solver.positions(particle, 1)[0].w, before);
    }
  }
}

TEST(MeshDivergence, NamesTheVertexOfASpringThatRunsAway) {
  Scene scene = test::meshScene();
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.setPosition(30, {0, 0, 50});
  solver.step(1);
  const auto divergence = solver.divergence();
  ASSERT_TRUE(divergence.has_value());
  EXPECT_EQ(divergence->reason, DivergenceReason::runawayStrain);
  EXPECT_NE(divergenceText(*divergence, cloth, scene).find("vertex"), std::string::npos);
}

}  // namespace
}  // namespace clothsim
