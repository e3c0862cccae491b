// Rows on what garments add to cloth: a balloon under pressure, a seam that carries, a sheet that shrinks,
// threads of two kinds, and cloth that tears under its own weight.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "measure/measure.h"
#include "solver/cpu/cpu_solver.h"
#include "support/mesh_sheet.h"
#include "support/test_scenes.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

// A sphere as an OBJ file, facing outwards: an icosahedron whose triangles are divided in four.
std::string sphereText(double radius, int divisions) {
  const double g = std::numbers::phi;
  std::vector<Vec3d> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                            {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<int, 3>> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int i = 0; i < divisions; ++i) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (isNew)
        points.push_back(0.5 * (points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]));
      return place->second;
    };
    std::vector<std::array<int, 3>> smaller;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      smaller.insert(smaller.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(smaller);
    for (Vec3d& point : points) point = (1 / length(point)) * point;
  }
  std::string text;
  for (const Vec3d& point : points) {
    const Vec3d p = (radius / length(point)) * point;
    text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  for (const auto& [a, b, c] : faces)
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  return text;
}

// Steps that are heavily damped, in the middle of nowhere.
Scene restingScene(const Material& material) {
  Scene scene;
  scene.cloths[0].material = material;
  scene.cloths[0].material->damping = 20;
  scene.gravity = {0, 0, 0};
  scene.solver.integrator = Integrator::implicit;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  scene.solver.tolerance = 1e-3;
  return scene;
}

// A thin sphere carries p r / 2, and grows by (1 - nu) p r / 2Y of its radius; nu is 1/3 where G is 3/8 Y.
template <class Real>
void expectBalloon() {
  constexpr double RADIUS = 0.1, STRETCH = 200, PRESSURE = 40;
  Scene scene = restingScene({.stretch = STRETCH, .shear = 0.375 * STRETCH, .bend = 1e-6});
  scene.cloths[0].mesh = test::meshFile(sphereText(RADIUS, 3));
  scene.cloths[0].pressure = PRESSURE;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(120);
  double sum = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    sum += length(solver.position(i).template cast<double>());
  const double grown = sum / cloth.particleCount() / RADIUS - 1;
  const double expected = 2.0 / 3 * PRESSURE * RADIUS / (2 * STRETCH);
  expectNear({"balloon", "growth of the radius under 40 Pa over (1 - nu) p r / 2Y", precisionOf<Real>, ""},
             grown / expected, 1, 0.05);
}

TEST(RowBalloon, CarriesPressureAsAThinSphere) {
  expectBalloon<double>();
  expectBalloon<float>();
}

// A strip that hangs from a seam of n springs of stiffness k: W / n k.
template <class Real>
void expectSeam() {
  constexpr double DENSITY = 0.2, SIDE = 0.1, STIFFNESS = 2;
  Scene scene = restingScene({.density = DENSITY, .stretch = 200, .shear = 30, .bend = 1e-6});
  ClothSettings& cloth = scene.cloths[0];
  cloth.width = cloth.height = SIDE;
  cloth.numWidthPoints = cloth.numHeightPoints = 5;
  scene.cloths.push_back(cloth);
  scene.cloths[0].pinned = {GridRange{{0, 0}, {4, 4}}};
  scene.cloths[1].position.z = 1.5 * SIDE;
  scene.gravity.z = GRAVITY;
  scene.seams.resize(1);
  scene.seams[0].a = {0, {GridSide::bottom}};
  scene.seams[0].b = {1, {GridSide::top}};
  scene.seams[0].time = 0.2;
  scene.seams[0].stiffness = STIFFNESS;
  const Cloth made(scene);
  CpuSolver<Real> solver(made, scene);
  solver.step(180);
  double sum = 0;
  for (const SeamSpring& spring : made.seams())
    sum +=
        static_cast<double>(solver.position(spring.b).z) - static_cast<double>(solver.position(spring.a).z);
  const double springs = static_cast<double>(made.seams().size());
  expectNear(
      {"seam", "gap at a seam of 5 springs that a strip hangs from over W / n k", precisionOf<Real>, ""},
      sum / springs / (DENSITY * SIDE * SIDE * GRAVITY / (springs * STIFFNESS)), 1, 0.01);
}

TEST(RowSeam, CarriesAStripAsItsSpringsDo) {
  expectSeam<double>();
  expectSeam<float>();
}

// Pressure pushes a sheet towards its front with p A in all.
TEST(Pressure, PushesTowardsTheFrontByItsArea) {
  for (const Orientation orientation : {Orientation::horizontal, Orientation::vertical})
    for (const bool asMesh : {false, true}) {
      Scene scene = test::sheetScene(9);
      if (asMesh) scene = test::meshScene({.columns = 9, .rows = 9, .edge = 0.1});
      scene.cloths[0].orientation = orientation;
      scene.cloths[0].pressure = 3;
      const Cloth cloth(scene);
      CpuSolver<double> solver(cloth, scene);
      const bool up = orientation == Orientation::horizontal && !asMesh;
      Vec3d sum;
      for (const Vec3d& force : solver.forces()) sum = sum + force;
      double area = 0;
      for (const auto& [a, b, c] : cloth.triangles()) {
        const Vec3d twice =
            cross(cloth.positions()[b] - cloth.positions()[a], cloth.positions()[c] - cloth.positions()[a]);
        area += 0.5 * (up ? twice.y : twice.z);  // without the jitter of standing sheets
      }
      EXPECT_NEAR(up ? sum.y : sum.z, 3 * area, 1e-6);
      EXPECT_NEAR(up ? sum.z : sum.y, 0, 1e-3);
    }
}

// Free cloth shrinks to its rest lengths, whatever it is made of.
TEST(Shrink, BringsSheetsToTheirNewSize) {
  for (const bool asMesh : {false, true}) {
    Scene scene = restingScene({.stretch = 500, .shear = 100, .bend = 1e-5});
    scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 9;
    if (asMesh) scene.cloths[0].mesh = test::meshSheetFile({.columns = 9, .rows = 9});
    scene.cloths[0].shrink = 0.2;
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    EXPECT_NEAR(measure(cloth, scene, solver.state()).maxStrain, 0.25, 1e-3);
    solver.step(120);
    const std::uint32_t last = cloth.particleCount() - 1;
    const double before = length(cloth.positions()[last] - cloth.positions()[0]);
    EXPECT_NEAR(length((solver.position(last) - solver.position(0)).cast<double>()) / before, 0.8, 2e-3);
    EXPECT_NEAR(measure(cloth, scene, solver.state()).maxStrain, 0, 2e-3);
  }
}

TEST(Shrink, KeepsTheLengthsOfCs184sTable) {
  Scene scene = test::sheetScene(6);
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].shrink = -0.25;
  const Cloth cloth(scene);
  ASSERT_TRUE(cloth.hasRestLengthTable());
  for (const Spring& spring : cloth.springs())
    EXPECT_NEAR(spring.restLength, 1.25 * length(cloth.positions()[spring.b] - cloth.positions()[spring.a]),
                1e-12);
  EXPECT_NEAR(measure(cloth, scene, initialState(cloth, scene)).maxStrain, -0.2, 1e-6);
}

// A strip with a weight on it, along the warp and along the weft: P / Y of each.
template <class Real>
void expectThreads() {
  for (const bool warp : {false, true}) {
    Scene scene =
        restingScene({.density = 0.2, .stretch = 200, .stretchWarp = 800, .shear = 30, .bend = 1e-7});
    ClothSettings& cloth = scene.cloths[0];
    cloth.width = warp ? 0.1 : 0.4;
    cloth.height = warp ? 0.4 : 0.1;
    cloth.numWidthPoints = warp ? 5 : 17;
    cloth.numHeightPoints = warp ? 17 : 5;
    cloth.pinned = {warp ? GridSide::top : GridSide::left};
    (warp ? scene.gravity.z : scene.gravity.x) = GRAVITY;
    const Cloth made(scene);
    CpuSolver<Real> solver(made, scene);
    solver.step(300);
    const std::uint32_t end = made.pieces()[0].particle(warp ? 2 : 16, warp ? 16 : 2);
    const double moved = length(solver.position(end).template cast<double>() - made.positions()[end]);
    const double stiffness = warp ? 800 : 200;
    expectNear({"threads",
                std::string("stretch under its own weight along the ") + (warp ? "warp" : "weft") +
                    " over rho g L^2 / 2Y",
                precisionOf<Real>, ""},
               moved / (0.2 * GRAVITY * 0.4 * 0.4 / (2 * stiffness)), 1, 0.05);
  }
}

TEST(RowThreads, StretchByTheirOwnModulus) {
  expectThreads<double>();
  expectThreads<float>();
}

// A strip that hangs has the strain rho g L / Y at its top; let go at once it swings to twice that.
Scene hangingStrip(double tearStrain) {
  Scene scene = restingScene({.density = 0.2, .stretch = 20, .shear = 5, .bend = 1e-6});
  ClothSettings& cloth = scene.cloths[0];
  cloth.width = 0.1;
  cloth.height = 1;
  cloth.numWidthPoints = 4;
  cloth.numHeightPoints = 31;
  cloth.rotation = {90, 0, 0};
  cloth.pinned = {GridSide::top};
  cloth.tearStrain = tearStrain;
  scene.gravity = {0, -GRAVITY, 0};
  return scene;
}

template <class Real>
State hung(double tearStrain) {
  const Scene scene = hangingStrip(tearStrain);
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(90);
  return solver.state();
}

TEST(RowTear, OfAStripThatHangsIsWhereItsWeightPullsMost) {
  const double strain = 0.2 * GRAVITY / 20;
  EXPECT_TRUE(hung<float>(2.1 * strain).cuts.empty());
  const State state = hung<float>(0.8 * strain);
  const Scene scene = hangingStrip(1);
  const Cloth cloth(scene);
  ASSERT_FALSE(state.cuts.empty());
  int lowest = 0, torn = 0;
  for (int row = 1; row < 31; ++row)
    for (int column = 0; column < 4; ++column)
      if (isCut(state.cuts, cloth.pieces()[0].particle(column, row), toUpper)) {
        lowest = std::max(lowest, row);
        ++torn;
      }
  expectNear({"tear of a hanging strip", "springs torn, of 4 side by side", "binary32", ""}, torn, 4, 0);
  expectAtMost({"tear of a hanging strip", "row where it tears, of 30 below the pins", "binary32", ""},
               lowest, 4);
  EXPECT_LT(state.positions.back().y, hung<float>(1).positions.back().y - 0.2) << "it falls";
  EXPECT_EQ(stateHash(state), stateHash(hung<float>(0.8 * strain)));
}

// The same strip as a mesh; its top row of triangles is pinned.
constexpr test::MeshSheet STRIP{.columns = 5, .rows = 36, .edge = 0.033};

Scene hangingMesh(double tearStrain) {
  Scene scene = hangingStrip(tearStrain);
  ClothSettings& cloth = scene.cloths[0];
  cloth = ClothSettings{};
  cloth.mesh = test::meshSheetFile(STRIP);
  cloth.material = Material{.density = 0.2, .stretch = 20, .shear = 5, .bend = 1e-6, .damping = 20};
  cloth.pinned = {GroupPin{"top"}};
  cloth.tearStrain = tearStrain;
  return scene;
}

State hungMesh(double tearStrain, bool untilItTears = false) {
  const Scene scene = hangingMesh(tearStrain);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  for (int frame = 0; frame < 90 && !(untilItTears && !solver.cuts().empty()); ++frame) solver.step(1);
  return solver.state();
}

// How many of the particles of the lowest row hang from the two pinned ones, over triangles.
int stillHanging(const Cloth& cloth, const Cuts& cuts) {
  const std::uint32_t count = cloth.particleCount();
  std::vector<bool> hangs(count);
  std::fill(hangs.end() - 2 * STRIP.columns, hangs.end(), true);
  for (bool more = true; more;) {
    more = false;
    for (const auto& [a, b, c] : remainingTriangles(cloth, cuts)) {
      if (hangs[a] == hangs[b] && hangs[b] == hangs[c]) continue;
      hangs[a] = hangs[b] = hangs[c] = more = true;
    }
  }
  return static_cast<int>(std::count(hangs.begin(), hangs.begin() + STRIP.columns, true));
}

// The tear begins below the clamp, which holds the mesh in width, too, so that some of its edges are
// stretched by more than the weight alone would; from there it goes along triangles.
TEST(RowTear, OfAMeshThatHangsBeginsWhereItsWeightPullsMost) {
  const double height = std::sqrt(0.75) * STRIP.edge, strain = 0.2 * GRAVITY * (STRIP.rows - 2) * height / 20;
  EXPECT_TRUE(hungMesh(2.5 * strain).cuts.empty());
  const Cloth cloth(hangingMesh(1));
  const double top = cloth.positions().back().y - height;
  const State first = hungMesh(0.8 * strain, true), state = hungMesh(0.8 * strain);
  ASSERT_FALSE(first.cuts.empty());
  double lowest = 0;
  for (std::uint32_t t = 0; t < cloth.triangleCount(); ++t)
    if (isLost(first.cuts, cloth, t))
      for (const std::uint32_t corner : cloth.lists().triangles[t])
        lowest = std::max(lowest, (top - cloth.positions()[corner].y) / height);
  expectAtMost(
      {"tear of a hanging strip", "row where a mesh tears first, of 34 below the pins", "binary32", ""},
      lowest, 2.01);
  expectNear({"tear of a hanging strip", "particles of a mesh's free end that hang on, of 5", "binary32", ""},
             stillHanging(cloth, state.cuts), 0, 0);
  EXPECT_EQ(stillHanging(cloth, {}), 5);
  EXPECT_LT(state.positions.front().y, hungMesh(1).positions.front().y - 0.2F) << "it falls";
  EXPECT_EQ(stateHash(state), stateHash(hungMesh(0.8 * strain)));
}

TEST(Tear, OfSpringsSideBySideTakesTheLongestFirst) {
  Scene scene = test::sheetScene(6);
  scene.cloths[0].tearStrain = 0.5;
  scene.gravity = {0, 0, 0};
  scene.solver.simulationSteps = 1;
  scene.solver.framesPerSec = 1e4;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  State state = solver.state();
  const Piece& piece = cloth.pieces()[0];
  state.positions[piece.particle(3, 2)].x += 0.15f;  // its left spring by 0.75, others by less
  solver.setState(state);
  solver.step(1);
  const Cuts& cuts = solver.cuts();
  ASSERT_FALSE(cuts.empty());
  EXPECT_TRUE(isCut(cuts, piece.particle(3, 2), toLeft));
  EXPECT_FALSE(isCut(cuts, piece.particle(4, 2), toLeft));
  EXPECT_FALSE(isCut(cuts, piece.particle(3, 3), toUpper));
  EXPECT_EQ(remainingTriangleCount(cloth, cuts), 50u - 4u) << "those of the two cells beside the spring";
}

}  // namespace
}  // namespace clothsim::validation
