// The stages of render.stage.
#include "render/stage_look.h"

#include "core/error.h"
#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"
#include "render/environment.h"

namespace clothsim {
namespace {

Scene drapeOn(std::string_view stage) {
  Scene scene = test::drapeScene();
  scene.camera.position = Vec3d{1.6, 1.15, 2.6};
  scene.camera.target = Vec3d{0.5, 0.42, 0.5};
  scene.render.stage = stage;
  return scene;
}

// But `none`, which is in the pictures of models and weaves.
const std::vector<std::string> furnished{"studio", "table", "window", "dark"};

class StagePicture : public GlTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(StagePicture, IsTheStoredOne) {
  const Image image = test::drawDrape(drapeOn(GetParam()), {}, 160, 100);
  EXPECT_LT(test::differenceFromReference("stage_" + GetParam(), image), test::TOLERANCE);
}

INSTANTIATE_TEST_SUITE_P(All, StagePicture, ::testing::ValuesIn(furnished),
                         [](const auto& stage) { return stage.param; });

// With this change the picture of `broken`, and no other, must be another one.
void expectOnlyOn(const std::string& file, const std::string& from, const std::string& to,
                  const std::string& broken) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change(file, from, to)) << file << " has changed: so must this test";
  const test::CommandResult result = resources.runTests("All/StagePicture.IsTheStoredOne/*");
  for (const std::string& stage : furnished) {
    const bool failed =
        result.output.find("FAILED  ] All/StagePicture.IsTheStoredOne/" + stage) != std::string::npos;
    EXPECT_EQ(failed, stage == broken) << stage << "\n" << result.output;
  }
}

TEST(BrokenStage, PaperThatDoesNotRiseIsSeenInTheStudio) {
  expectOnlyOn("render/stage.glsl", "smoothstep(RISES, STAGE_SIZES, length(at))", "0.0", "studio");
}
TEST(BrokenStage, ATableWithoutAnEdgeIsSeen) {
  expectOnlyOn("render/stage.glsl", "vec2(HALF_TABLE_LENGTH, HALF_TABLE_DEPTH)", "vec2(4.0, 4.0)", "table");
}
TEST(BrokenStage, AWindowWithoutBarsIsSeen) {
  expectOnlyOn("render/window.glsl", "mix(1.0, bars.x * bars.y, 0.8)", "1.0", "window");
}
TEST(BrokenStage, ASpotThatLightsTheWholeGroundIsSeenOnTheDarkStage) {
  expectOnlyOn("render/stage.glsl", "1.0 - smoothstep(0.30, 1.45, distance2)", "1.0", "dark");
}

TEST(StageLook, IsThereForEachName) {
  for (const std::string_view stage : stages) EXPECT_EQ(stageLook(stage).name, stage);
  EXPECT_THROW(static_cast<void>(stageLook("moon")), SceneError);
}

// A lamp to the left, as in the room by the window, is light from the left.
TEST(Surroundings, AreLitFromWhereTheMainLightIs) {
  const Environment room("window", glm::normalize(glm::vec3(-1, 0.5f, 0)));
  const auto terms = room.irradiance();
  EXPECT_LT(terms[1].x, -0.05f) << "the part that grows with x";
  EXPECT_GT(room.lightFrom({-0.9f, 0.45f, 0}).x, 2 * room.lightFrom({0.9f, 0.45f, 0}).x);
}

}  // namespace
}  // namespace clothsim
