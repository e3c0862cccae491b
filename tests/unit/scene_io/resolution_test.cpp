// --resolution
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene_io/scene_io.h"
#include "support/scene_text.h"
#include "support/throws.h"

namespace clothsim {
namespace {

using test::sceneOf;

TEST(ChangeResolution, KeepsCornersCorners) {
  Scene scene = loadSceneByName("pinned4");
  (void)changeResolution(scene, 256, 128, false);
  EXPECT_EQ(scene.cloths[0].numWidthPoints, 256);
  EXPECT_EQ(scene.cloths[0].numHeightPoints, 128);
  EXPECT_EQ(scene.cloths[0].pinned,
            (std::vector<Pin>{GridPoint{0, 0}, GridPoint{0, 127}, GridPoint{255, 0}, GridPoint{255, 127}}));
}

TEST(ChangeResolution, MovesInnerPinsAndRangesAlongAndLeavesSides) {
  Scene scene = sceneOf(
      R"({"cloth": {"num_width_points": 11, "num_height_points": 21,
          "pinned": [[5, 10], {"from": [2, 0], "to": [8, 20]}, "left"]}})");
  (void)changeResolution(scene, 101, 41, false);
  EXPECT_EQ(scene.cloths[0].pinned,
            (std::vector<Pin>{GridPoint{50, 20}, GridRange{{20, 0}, {80, 40}}, GridSide::left}));
}

TEST(FollowGrids, MovesPinsOfWhatHasAnotherGridAndTakesTheStepsThatItNeeds) {
  const Scene before = sceneOf(
      R"({"cloths": [{"num_width_points": 11, "num_height_points": 21, "thickness": 0.01, "pinned": [[10, 10]]},
                     {"num_width_points": 11, "num_height_points": 21, "pinned": [[10, 10]]}],
          "solver": {"simulation_steps": 30}})");
  Scene edited = before;
  edited.cloths[0].numWidthPoints = 41;
  followGrids(edited, before);
  EXPECT_EQ(edited.cloths[0].pinned, (std::vector<Pin>{GridPoint{40, 10}}));
  EXPECT_EQ(edited.cloths[0].numWidthPoints, 41);
  EXPECT_LT(edited.cloths[0].thickness, 0.01);
  EXPECT_EQ(edited.cloths[1], before.cloths[1]);
  EXPECT_EQ(edited.solver.simulationSteps, 120);
  followGrids(edited, edited);
  EXPECT_EQ(edited.solver.simulationSteps, 120) << "nothing has changed";
}

// A slider has set the new numbers of points already, while the pins are those of the finer grid.
TEST(FollowGrids, CoarsensAClothWithMovedPinsInItsLastRow) {
  const Scene before = sceneOf(
      R"({"cloth": {"num_width_points": 31, "num_height_points": 31, "pinned": [{"from": [0, 30], "to": [30, 30]}],
          "pin_motion": [{"keys": [{"t": 0}], "pinned": [{"from": [0, 30], "to": [30, 30]}]}]}})");
  Scene edited = before;
  edited.cloths[0].numWidthPoints = edited.cloths[0].numHeightPoints = 10;
  followGrids(edited, before);
  EXPECT_EQ(edited.cloths[0].pinned, (std::vector<Pin>{GridRange{{0, 9}, {9, 9}}}));
  EXPECT_EQ(edited.cloths[0].pinMotion[0].pinned, edited.cloths[0].pinned);
}

TEST(FollowGrids, RefusesAGridOnWhichPinsOfTwoMotionsMeet) {
  const Scene before = sceneOf(
      R"({"cloth": {"num_width_points": 10, "num_height_points": 31, "pinned": [[0, 30], [1, 30]],
          "pin_motion": [{"keys": [{"t": 0}], "pinned": [[0, 30]]}, {"keys": [{"t": 0}], "pinned": [[1, 30]]}]}})");
  Scene edited = before;
  edited.cloths[0].numWidthPoints = edited.cloths[0].numHeightPoints = 5;
  EXPECT_EQ(
      test::messageThrownBy<UsageError>([&] { followGrids(edited, before); }),
      "5x5 points: two of a cloth's pin motions would meet in point [0, 4]; expected a grid fine enough "
      "to tell their pins apart");
}

TEST(ChangeResolution, MovesThePinsOfMotionsAlong) {
  Scene scene = sceneOf(
      R"({"cloth": {"num_width_points": 11, "num_height_points": 21, "pinned": ["left", {"from": [5, 0], "to": [5, 20]}],
          "pin_motion": [{"keys": [{"t": 0}], "pinned": [{"from": [5, 0], "to": [5, 20]}]},
                         {"keys": [{"t": 0}], "pinned": [[0, 10]]}]}})");
  (void)changeResolution(scene, 101, 41, false);
  EXPECT_EQ(scene.cloths[0].pinMotion[0].pinned, (std::vector<Pin>{GridRange{{50, 0}, {50, 40}}}));
  EXPECT_EQ(scene.cloths[0].pinMotion[1].pinned, (std::vector<Pin>{GridPoint{0, 20}}));
  EXPECT_EQ(parseScene(formatScene(scene), "changed"), scene);
}

TEST(ChangeResolution, RefusesAGridOnWhichPinsOfTwoMotionsMeet) {
  Scene scene = sceneOf(
      R"({"cloth": {"num_width_points": 10, "pinned": ["left", [1, 0]],
          "pin_motion": [{"keys": [{"t": 0}], "pinned": ["left"]}, {"keys": [{"t": 0}], "pinned": [[1, 0]]}]}})");
  const Scene before = scene;
  EXPECT_EQ(
      test::messageThrownBy<UsageError>([&] { (void)changeResolution(scene, 5, 50, false); }),
      "--resolution 5x50: two of a cloth's pin motions would meet in point [0, 0]; expected a grid fine "
      "enough to tell their pins apart");
  EXPECT_EQ(scene, before);
}

TEST(ChangeResolution, RefusesAMotionOfPointsBetweenTheCoarserPins) {
  Scene scene = sceneOf(
      R"({"cloth": {"num_width_points": 10, "pinned": [[0, 0], [1, 0]],
          "pin_motion": [{"keys": [{"t": 0}], "pinned": [{"from": [0, 0], "to": [1, 0]}]}]}})");
  EXPECT_EQ(test::messageThrownBy<UsageError>([&] { (void)changeResolution(scene, 50, 50, false); }),
            "--resolution 50x50: a pin motion would move point [1, 0], which is not pinned then; expected "
            "\"pinned\" and \"pin_motion\" to name the same ranges or points");
}

TEST(ChangeResolution, LeavesSizeMassAndStiffness) {
  Scene scene = loadSceneByName("pinned2");
  const ClothSettings before = scene.cloths[0];
  (void)changeResolution(scene, 256, 256, false);
  const ClothSettings& after = scene.cloths[0];
  EXPECT_EQ(after.width * after.height * after.density, before.width * before.height * before.density);
  EXPECT_EQ(after.ks, before.ks);
  EXPECT_EQ(after.damping, before.damping);
}

TEST(ChangeResolution, LetsThicknessFollowTheSmallerSpacingInKsScenes) {
  Scene scene = loadSceneByName("pinned2");
  (void)changeResolution(scene, 99, 148, false);  // spacings 1/98 and 1/147, of 1/49
  EXPECT_NEAR(scene.cloths[0].thickness, 0.0095 / 3, 1e-15);
  Scene coarser = loadSceneByName("pinned2");
  (void)changeResolution(coarser, 8, 8, false);
  EXPECT_NEAR(coarser.cloths[0].thickness, 0.0095 * 7, 1e-15);
}

TEST(ChangeResolution, LeavesThicknessInOtherScenes) {
  Scene scene = loadSceneByName("cs171");
  const double before = scene.cloths[0].thickness;
  (void)changeResolution(scene, 157, 117, false);
  EXPECT_EQ(scene.cloths[0].thickness, before);
}

TEST(ChangeResolution, MultipliesStepsByTheCeilingOfTheSpacingRatio) {
  const auto steps = [](int columns, int rows) {
    Scene scene = loadSceneByName("pinned2");
    (void)changeResolution(scene, columns, rows, false);
    return scene.solver.simulationSteps;
  };
  EXPECT_EQ(steps(50, 50), 30);
  EXPECT_EQ(steps(51, 50), 60);
  EXPECT_EQ(steps(99, 99), 60);     // 98 / 49 is 2 exactly
  EXPECT_EQ(steps(100, 99), 90);    // and 99 / 49 is above
  EXPECT_EQ(steps(256, 256), 180);  // 255 / 49 = 5.2
  EXPECT_EQ(steps(20, 20), 30);
}

TEST(ChangeResolution, MultipliesStepsByThePowerThreeHalvesWithAStiffnessReference) {
  Scene scene = loadSceneByName("cs171");
  (void)changeResolution(scene, 157, 117, false);  // 156 / 39 = 116 / 29 = 4
  EXPECT_EQ(scene.solver.simulationSteps, 80);
}

TEST(ChangeResolution, LeavesStepsThatWereSetByHand) {
  Scene scene = loadSceneByName("pinned2");
  (void)changeResolution(scene, 256, 256, true);
  EXPECT_EQ(scene.solver.simulationSteps, 30);
}

TEST(ChangeResolution, SaysWhatElseItChanged) {
  Scene scene = loadSceneByName("pinned2");
  EXPECT_EQ(changeResolution(scene, 99, 99, false),
            "at 99x99: cloth.thickness 0.0095 -> 0.00475, solver.simulation_steps 30 -> 60");
  EXPECT_EQ(changeResolution(scene, 99, 99, false), "");
  Scene other = loadSceneByName("cs171");
  EXPECT_EQ(changeResolution(other, 80, 60, true), "");
}

TEST(ChangeResolution, SaysOfWhichClothItChangedTheThickness) {
  Scene scene = sceneOf(R"({"cloths": [{"thickness": 0.01}, {"thickness": 0.02, "stiffness_reference": 1},
                                       {"thickness": 0.03}]})");
  EXPECT_EQ(changeResolution(scene, 99, 99, true),
            "at 99x99: cloths.0.thickness 0.01 -> 0.005, cloths.2.thickness 0.03 -> 0.015");
}

TEST(ChangeResolution, GivesAllClothsTheGrid) {
  Scene scene = sceneOf(R"({"cloths": [{"num_width_points": 10}, {"num_width_points": 20}]})");
  (void)changeResolution(scene, 64, 32, false);
  for (const ClothSettings& cloth : scene.cloths) {
    EXPECT_EQ(cloth.numWidthPoints, 64);
    EXPECT_EQ(cloth.numHeightPoints, 32);
  }
}

TEST(ChangeResolution, RefusesAbsurdSizes) {
  for (const auto& [columns, rows] :
       {std::pair{1, 50}, {50, 0}, {-3, 50}, {16385, 2}, {65536, 65536}, {16384, 16384}}) {
    Scene scene = loadSceneByName("pinned2");
    EXPECT_THROW((void)changeResolution(scene, columns, rows, false), UsageError) << columns << "x" << rows;
    EXPECT_EQ(scene, loadSceneByName("pinned2"));
  }
}

TEST(ChangeResolution, GivesScenesThatCanBeSavedAndLoaded) {
  for (const auto& [columns, rows] : {std::pair{2, 2}, {3, 700}, {16384, 2}, {8192, 8192}}) {
    for (const BundledScene& bundled : bundledScenes()) {
      if (columns * rows > 100'000 && !bundled.name.starts_with("pinned"))
        continue;  // most of the time is theirs
      Scene scene = loadScene(bundled.path);
      const bool pinsMeet = !scene.cloths[0].pinMotion.empty() && columns == 2;
      const bool refusesOblongCells = scene.cloths[0].material && columns != rows;
      if (scene.cloths.size() > 1 || scene.cloths[0].isMesh() || pinsMeet || refusesOblongCells) continue;
      (void)changeResolution(scene, columns, rows, false);
      EXPECT_EQ(parseScene(formatScene(scene), "changed"), scene)
          << bundled.name << " " << columns << "x" << rows;
    }
  }
}

}  // namespace
}  // namespace clothsim
