// Physics of cloth made of a mesh, against formulas for the sheet that it stands for.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cloth/material.h"
#include "measure/crossings.h"
#include "measure/energies.h"
#include "measure/measure.h"
#include "solver/cpu/cpu_solver.h"
#include "support/membrane_energy.h"
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

// The stress of a sheet drawn out by a small strain, from the virial of its forces: xx, yy, xy, yx.
std::array<double, 4> virialStress(const Scene& scene, const test::MeshSheet& sheet,
                                   const std::array<double, 3>& strain) {
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  const auto [xx, yy, xy] = strain;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d p = cloth.positions()[i];
    solver.setPosition(i, {(1 + xx) * p.x + 0.5 * xy * p.y, 0.5 * xy * p.x + (1 + yy) * p.y, p.z});
  }
  const std::vector<Vec3d> forces = solver.forces();
  std::array<double, 4> sums{};
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d p = cloth.positions()[i], f = (-1 / areaOf(sheet)) * forces[i];
    sums = {sums[0] + p.x * f.x, sums[1] + p.y * f.y, sums[2] + p.x * f.y, sums[3] + p.y * f.x};
    const auto column = static_cast<int>(i) % sheet.columns, row = static_cast<int>(i) / sheet.columns;
    const bool isInside = row > 0 && row + 1 < sheet.rows && column > 0 && column + 1 < sheet.columns;
    EXPECT_LT(isInside ? length(f) : 0, 1e-9) << "a patch: no force inside, whatever the triangles";
  }
  return sums;
}

TEST(MeshMembrane, CarriesTheStressOfItsModuliWhateverItsTriangles) {
  const Material material{.stretch = 300, .stretchWarp = 120, .shear = 20, .bend = 0};
  constexpr double e = 1e-6;
  for (const double disorder : {0.0, 0.3})
    for (const std::array<double, 3>& strain :
         {std::array{e, 0.0, 0.0}, {0.0, e, 0.0}, {0.0, 0.0, e}, {-e, 0.5 * e, 2 * e}}) {
      const test::MeshSheet sheet{.disorder = disorder};
      const std::array<double, 4> found = virialStress(materialScene(sheet, material), sheet, strain);
      const std::array<double, 3> expected = test::stressOf(sheetModuli(material), strain);
      constexpr double tolerance = 300 * e * 2e-5;
      EXPECT_NEAR(found[0], expected[0], tolerance);
      EXPECT_NEAR(found[1], expected[1], tolerance);
      EXPECT_NEAR(found[2], expected[2], tolerance);
      EXPECT_NEAR(found[3], expected[2], tolerance);
    }
}

// The weft is where the texture's u is, whatever the shape of the mesh: here along y, so that x is the warp.
TEST(MeshMembrane, TakesItsWeftFromTheTexture) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
  Scene scene;
  scene.cloths[0].mesh = test::meshFile(text);
  scene.cloths[0].material = Material{.stretch = 300, .stretchWarp = 120, .shear = 20};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  constexpr double e = 1e-6;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Vec3d p = cloth.positions()[i];
    solver.setPosition(i, {(1 + e) * p.x, p.y, p.z});
  }
  const std::vector<Vec3d> forces = solver.forces();
  EXPECT_NEAR(-(forces[1].x + forces[2].x), sheetModuli(*scene.cloths[0].material).c22 * e, 1e-4 * 300 * e);
}

// A unit square in the plane z = 0, its inner points moved about, pinned along y = 0.
std::string squareText(int n) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-0.25 / n, 0.25 / n);
  std::string text;
  for (int row = 0; row <= n; ++row)
    for (int column = 0; column <= n; ++column) {
      const bool inside = row > 0 && row < n && column > 0 && column < n;
      text += "v " + std::to_string(1.0 * column / n + (inside ? uniform(engine) : 0)) + " " +
              std::to_string(1.0 * row / n + (inside ? uniform(engine) : 0)) + " 0\n";
    }
  const auto face = [&](int a, int b, int c) {
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const int a = row * (n + 1) + column + 1, b = a + 1, c = a + n + 1, d = c + 1;
      (row + column) % 2 == 0 ? (face(a, b, d), face(a, d, c)) : (face(a, b, c), face(b, d, c));
    }
  return text;
}

// How far the middle of the free side gives way to a pull in the plane.
Vec3d displacementUnder(Scene scene, Vec3d gravity, std::uint32_t middle) {
  scene.gravity = gravity;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(20);
  return solver.position(middle) - cloth.positions()[middle];
}

TEST(MeshMembrane, GivesWayAsAGridOfTheSameMaterialDoes) {
  constexpr int n = 10;
  Scene mesh, grid;
  for (Scene* scene : {&mesh, &grid}) {
    scene->cloths[0].material =
        Material{.density = 0.1, .stretch = 300, .stretchWarp = 150, .shear = 20, .bend = 0, .damping = 30};
    scene->solver.integrator = Integrator::implicit;
    scene->solver.framesPerSec = 4;
    scene->solver.simulationSteps = 1;
    scene->solver.tolerance = 1e-4;
    scene->solver.cgIterations = 200;
  }
  mesh.cloths[0].mesh = test::meshFile(squareText(n));
  mesh.cloths[0].pinned = {RegionPin{{{-0.01, -0.01, -1}, {1.01, 0.01, 1}}}};
  grid.cloths[0].numWidthPoints = grid.cloths[0].numHeightPoints = n + 1;
  grid.cloths[0].pinned = {GridRange{{0, 0}, {n, 0}}};
  constexpr std::uint32_t middle = n * (n + 1) + n / 2;
  const Vec3d meshDown = displacementUnder(mesh, {0, 5, 0}, middle),
              gridDown = displacementUnder(grid, {0, 0, 5}, middle),
              meshAcross = displacementUnder(mesh, {1, 0, 0}, middle),
              gridAcross = displacementUnder(grid, {1, 0, 0}, middle);
  EXPECT_NEAR(gridDown.z, 0.5 * 0.1 * 5 / 150, 2e-4) << "rho g L^2 / 2 Y'";
  EXPECT_NEAR(meshDown.y, gridDown.z, 0.02 * gridDown.z);
  EXPECT_GT(gridAcross.x, 0.5 * 0.1 * 1 / 20) << "shear alone";
  EXPECT_NEAR(meshAcross.x, gridAcross.x, 0.03 * gridAcross.x);
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
  const Material material{.stretch = 50, .stretchWarp = 80, .shear = 10, .bend = 1e-3};
  const Scene scene = materialScene({.columns = 6, .rows = 7, .disorder = 0.2}, material);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-0.01, 0.01);
  std::vector<Vec3d> x = positionsOf(cloth);
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    x[i] = x[i] + Vec3d{uniform(engine), uniform(engine), uniform(engine)};
    solver.setPosition(i, x[i]);
  }
  const auto energy = [&] { return test::membraneEnergy(cloth, material, x) + bendingEnergy(cloth, x); };
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
