// What is wrong with a scene before its first step.
#include <gtest/gtest.h>

#include "measure/measure.h"
#include "measure/run_watch.h"
#include "solver/solver.h"
#include "support/scene_text.h"

namespace clothsim {
namespace {

ColliderOverlaps overlapsOf(const Scene& scene) {
  const Cloth cloth(scene);
  return overlapsWithColliders(cloth, scene, initialState(cloth, scene));
}

// A sheet 0.2 m below a plane: CS184's planes hold cloth on both sides, others push it out.
TEST(StartOverlaps, KnowWhichPlanesHaveAnInside) {
  const std::string sheet =
      R"({"cloth": {"num_width_points": 9, "num_height_points": 9, "position": [0, -1.2, 0]},
                                "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0]}],
                                "solver": {"friction_law": ")";
  EXPECT_EQ(overlapsOf(test::sceneOf(sheet + R"(cs184"}})")).particles, 0u);
  const ColliderOverlaps coulomb = overlapsOf(test::sceneOf(sheet + R"(coulomb"}})"));
  EXPECT_EQ(coulomb.particles, 81u);
  EXPECT_NEAR(coulomb.depth, 0.2, 1e-6);
}

// Two panels, one beside the other.
Scene panels(const std::string& distance) {
  return test::sceneOf(
      R"({"cloths": [{"num_width_points": 7, "num_height_points": 11, "material": "cotton"},
                     {"num_width_points": 7, "num_height_points": 11, "material": "cotton", "position": [)" +
      distance + ", 0, 0]}]}");
}

TEST(StartOverlaps, TellOfPointsThatCoincideWhereContactWouldHoldThem) {
  const auto pointsOf = [](const Scene& scene) {
    const Cloth cloth(scene);
    return coincidentPoints(cloth, initialState(cloth, scene));
  };
  EXPECT_EQ(pointsOf(panels("1")), 22u);
  EXPECT_EQ(pointsOf(panels("1.0005")), 0u);
  Scene sewn = panels("1");
  Seam seam;
  seam.a = {0, {GridSide::right}};
  seam.b = {1, {GridSide::left}};
  sewn.seams = {seam};
  EXPECT_EQ(pointsOf(sewn), 0u);
  const auto warningsOf = [](const Scene& scene) {
    const Cloth cloth(scene);
    RunWatch watch;
    watch.start(cloth, scene, initialState(cloth, scene));
    return watch.warnings(scene);
  };
  const std::vector<Warning> warnings = warningsOf(panels("1"));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].text.starts_with("22 points lie on others")) << warnings[0].text;
  Scene robust = panels("1");
  robust.solver.selfCollision = SelfCollision::robust;
  EXPECT_TRUE(warningsOf(robust).empty());
}

TEST(Warnings, TellOfPlanesWhoseFrictionDoesNotAct) {
  Scene scene = test::sceneOf(
      R"({"cloth": {"num_width_points": 3, "num_height_points": 3}, "solver": {"integrator": "implicit"},
          "plane": {"point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0.3}})");
  EXPECT_EQ(RunWatch().warnings(scene).size(), 1u);
  Scene slippery = scene;
  std::get<Plane>(slippery.colliders[0]).friction = 0;
  EXPECT_TRUE(RunWatch().warnings(slippery).empty());
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  EXPECT_TRUE(RunWatch().warnings(scene).empty());
}

TEST(Warnings, TellOfPinsFarBehindTheirPaths) {
  const Scene scene = test::sceneOf(R"({"cloth": {"num_width_points": 11, "num_height_points": 11}})");
  const Cloth cloth(scene);
  const State state = initialState(cloth, scene);
  ContactCounts counts;
  RunWatch watch;
  counts.pinLag = 0.04;  // less than half a spacing
  watch.add(1, cloth, scene, state, 0, counts);
  EXPECT_TRUE(watch.warnings(scene).empty());
  counts.pinLag = 0.06;
  watch.add(2, cloth, scene, state, 0, counts);
  const std::vector<Warning> warnings = watch.warnings(scene);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].frame, 2);
  EXPECT_NE(warnings[0].text.find("60 mm behind"), std::string::npos) << warnings[0].text;
}

}  // namespace
}  // namespace clothsim
