// Meshes that tear: what goes with an edge, which edge goes first, and what is left of cloth that falls
// apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "export/formats.h"
#include "measure/energies.h"
#include "measure/measure.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/tearing.h"
#include "support/mesh_sheet.h"

namespace clothsim {
namespace {

constexpr test::MeshSheet SHEET{.columns = 8, .rows = 9, .edge = 0.05};

Scene springScene() { return test::meshScene(SHEET); }
Scene fabricScene() {
  Scene scene = springScene();
  scene.cloths[0].ks.reset();
  scene.cloths[0].material = Material{.stretch = 300, .shear = 100, .bend = 1e-5, .damping = 0};
  return scene;
}

const MeshSpring& edgeBetween(const Cloth& cloth, std::uint32_t i, std::uint32_t j) {
  return cloth.lists().springs[cloth.lists().edgeBetween(i, j).value()];
}

TEST(TornMesh, LosesTheTrianglesBesideAnEdgeAndAllThatTheyHeld) {
  for (const Scene& scene : {springScene(), fabricScene()}) {
    const Cloth cloth(scene);
    const MeshSpring& edge = edgeBetween(cloth, 28, 27);
    Cuts cuts;
    tearEdge(cuts, cloth, edge);
    EXPECT_EQ(cuts.size(), cutsSize(cloth));
    EXPECT_EQ(remainingTriangleCount(cloth, cuts), cloth.triangleCount() - 2);
    for (const auto& [a, b, c] : remainingTriangles(cloth, cuts))
      EXPECT_EQ((a == 27 || b == 27 || c == 27) && (a == 28 || b == 28 || c == 28), false);
    EXPECT_FALSE(areJoined(cuts, cloth, 28, 27));
    std::uint64_t springs = 0;
    for (const MeshSpring& spring : cloth.lists().springs) {
      springs += isCut(cuts, cloth, spring) ? 0 : 1;
      if (spring.kind != SpringKind::structural) continue;
      EXPECT_EQ(isCut(cuts, cloth, spring), &spring == &edge) << "the other sides have a triangle left";
    }
    EXPECT_EQ(remainingSpringCount(cloth, cuts), springs);
    const std::uint64_t across = scene.cloths[0].material ? 0 : 5;  // its own, and those of the four sides
    EXPECT_EQ(springs, cloth.springCount() - 1 - across);
    const SpringLists left = remainingLists(cloth, cuts);
    EXPECT_EQ(left.springsOf.entries.size(), 2 * springs);
    EXPECT_EQ(left.trianglesOf.entries.size(), 3 * (cloth.triangleCount() - 2));
    EXPECT_EQ(left.hingesOf.entries.size(),
              4 * (cloth.lists().hinges.size() - (scene.cloths[0].material ? 5 : 0)));
    EXPECT_EQ(left.membranesOf.entries.size(),
              3 * (cloth.lists().membranes.size() - (scene.cloths[0].material ? 2 : 0)));
    EXPECT_EQ(left.springs.size(), cloth.lists().springs.size()) << "numbers stay";
  }
}

TEST(TornMesh, LosesAnEdgeOfTheBorderWithItsTriangle) {
  const Cloth cloth(springScene());
  Cuts cuts;
  tearEdge(cuts, cloth, edgeBetween(cloth, 1, 0));
  EXPECT_EQ(remainingTriangleCount(cloth, cuts), cloth.triangleCount() - 1);
  EXPECT_FALSE(areJoined(cuts, cloth, 1, 0));
  EXPECT_TRUE(areJoined(cuts, cloth, 2, 1));
}

TEST(TornMesh, TearsAtTheLongestOfTheEdgesThatMeet) {
  Scene scene = springScene();
  scene.cloths[0].tearStrain = 0.1;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  State state = solver.state();
  state.positions[28].x += 0.02f;  // from 27 by 0.4, from those above and below by less
  Cuts cuts;
  ASSERT_TRUE(tear(cuts, cloth, scene, state.positions));
  EXPECT_FALSE(areJoined(cuts, cloth, 28, 27));
  EXPECT_EQ(remainingTriangleCount(cloth, cuts), cloth.triangleCount() - 2) << "all others wait";
  scene.cloths[0].tearStrain = 0.5;
  Cuts none;
  EXPECT_FALSE(tear(none, cloth, scene, state.positions));
  EXPECT_TRUE(none.empty());
}

TEST(TornMesh, TearsWhileItIsStepped) {
  Scene scene = springScene();
  scene.cloths[0].tearStrain = 0.3;
  scene.solver.simulationSteps = 1;
  scene.solver.framesPerSec = 1e4;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  State state = solver.state();
  state.positions[28].x += 0.02f;
  solver.setState(state);
  solver.step(1);
  EXPECT_FALSE(areJoined(solver.cuts(), cloth, 28, 27));
}

// Explicit and implicit, springs and membranes, with a strain limit that would hold what is lost.
TEST(TornMesh, LetsWhatIsTornOffFallFreely) {
  for (Scene scene : {springScene(), fabricScene()})
    for (const Integrator integrator : {Integrator::verlet, Integrator::implicit}) {
      scene.solver.integrator = integrator;
      scene.solver.framesPerSec = 60;
      scene.solver.simulationSteps = integrator == Integrator::verlet ? 200 : 1;
      scene.solver.strainLimit = 0.1;
      scene.cloths[0].damping = 0;
      scene.cloths[0].pinned = {GroupPin{"top"}};
      scene.gravity = {0, -9.81, 0};
      const Cloth cloth(scene);
      CpuSolver<double> solver(cloth, scene);
      const double middle = 3.5 * std::sqrt(0.75) * SHEET.edge;
      solver.setCuts(test::tornAcross(cloth, middle));
      constexpr int frames = 12;
      solver.step(frames * scene.solver.simulationSteps);
      EXPECT_EQ(solver.divergence(), std::nullopt);
      const double h = 1.0 / (60 * static_cast<int>(scene.solver.simulationSteps)), t = frames / 60.0;
      const double expected = 0.5 * 9.81 * t * (integrator == Integrator::verlet ? t : t + h);
      for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
        const double fallen = cloth.positions()[i].y - solver.position(i).y;
        const bool isOff = cloth.positions()[i].y < middle;
        EXPECT_NEAR(fallen, isOff ? expected : 0, isOff ? 0.01 * expected : 0.02) << i;
      }
      const Measures measures = measure(cloth, scene, solver.state());
      EXPECT_LT(measures.maxStrain, 0.2) << "what is lost is not measured";
      const State state = solver.state();
      EXPECT_LT(energies(cloth, cloth.springs(), scene, state.cuts, state).maxStrain, 0.2);
    }
}

// Every triangle: the particles weigh what they did, and fall.
TEST(TornMesh, FallsToCrumbsThatKeepTheirMass) {
  for (const Integrator integrator : {Integrator::euler, Integrator::implicit}) {
    Scene scene = fabricScene();
    scene.solver.integrator = integrator;
    scene.solver.framesPerSec = 60;
    scene.solver.simulationSteps = 1;
    scene.solver.selfCollision =
        integrator == Integrator::implicit ? SelfCollision::contact : SelfCollision::robust;
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    Cuts cuts;
    for (const MeshSpring& spring : cloth.lists().springs) tearEdge(cuts, cloth, spring);
    solver.setCuts(cuts);
    solver.step(10);
    const State state = solver.state();
    EXPECT_TRUE(remainingTriangles(cloth, cuts).empty());
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
      EXPECT_EQ(state.positions[i].w, static_cast<float>(1 / cloth.massOf(i)));
      EXPECT_NEAR(cloth.positions()[i].y - static_cast<double>(state.positions[i].y),
                  9.8 * 10 * 11 / 2 / 3600, 1e-3);
    }
  }
}

TEST(TornMesh, IsSavedAndLoaded) {
  const Scene scene = springScene();
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.setCuts(test::tornAcross(cloth, 0.1));
  const State state = solver.state();
  const std::string bytes = formatStateFile(state);
  const std::size_t triangles = cloth.lists().triangles.size();
  EXPECT_EQ(parseStateFile(bytes, cloth.particleCount(), "torn.state", triangles).cuts, state.cuts);
  EXPECT_ANY_THROW((void)parseStateFile(bytes, cloth.particleCount(), "torn.state", triangles + 1));
  EXPECT_ANY_THROW((void)parseStateFile(bytes, cloth.particleCount(), "torn.state"));
}

// Restored to before, it is whole again to the bit.
TEST(TornMesh, IsWholeAgainWhereItsStateIsTakenBack) {
  Scene scene = fabricScene();
  scene.solver.integrator = Integrator::implicit;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  scene.cloths[0].pinned = {VertexPin{0}, VertexPin{7}};
  const Cloth cloth(scene);
  CpuSolver<float> torn(cloth, scene), whole(cloth, scene);
  const State start = torn.state();
  torn.setCuts(test::tornAcross(cloth, 0.1));
  torn.step(3);
  torn.setState(start);
  torn.step(5);
  whole.step(5);
  EXPECT_EQ(stateHash(torn.state()), stateHash(whole.state()));
}

}  // namespace
}  // namespace clothsim
