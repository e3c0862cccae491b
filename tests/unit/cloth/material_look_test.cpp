// What a scene looks like that names a material and no look.
#include "cloth/material_look.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cloth/material.h"
#include "scene_io/scene_io.h"
#include "support/scene_text.h"

namespace clothsim {
namespace {

using test::sceneOf;

TEST(MaterialLook, IsThatOfTheFabric) {
  const Scene denim = sceneOf(R"({"cloth": {"material": "denim"}})");
  EXPECT_EQ(denim.render.weave, "denim");
  EXPECT_GT(denim.render.color.z, 2 * denim.render.color.x) << "indigo";
  EXPECT_EQ(sceneOf(R"({"cloth": {"material": "jersey"}})").render.weave, "jersey");
  EXPECT_EQ(sceneOf(R"({"cloth": {"material": "silk"}})").render.weave, "satin");
  EXPECT_EQ(sceneOf(R"({"cloth": {"material": "paper"}})").render.weave, "none");
}

TEST(MaterialLook, IsOneForEachPresetAndNoneWithoutAMaterial) {
  EXPECT_EQ(sceneOf(R"({"cloth": {}})").render, RenderSettings{});
  for (const std::string& name : materialPresetNames()) {
    const RenderSettings look = sceneOf(R"({"cloth": {"material": ")" + name + R"("}})").render;
    EXPECT_NE(look, RenderSettings{}) << name;
    EXPECT_NE(std::find(weaves.begin(), weaves.end(), look.weave), weaves.end()) << name;
  }
}

TEST(MaterialLook, GivesWayToWhatTheSceneSays) {
  const Scene scene =
      sceneOf(R"({"render": {"weave": "plain", "color": [0.7, 0.1, 0.12]}, "cloth": {"material": "denim"}})");
  EXPECT_EQ(scene.render.weave, "plain");
  EXPECT_EQ(scene.render.color, RenderSettings{}.color);
  EXPECT_EQ(sceneOf(formatScene(scene)).render, scene.render);
}

TEST(MaterialLook, IsNotWrittenAndReadAgain) {
  const Scene scene = sceneOf(R"({"cloth": {"material": "wool"}})");
  EXPECT_EQ(formatScene(scene).find("weave"), std::string::npos);
  EXPECT_EQ(sceneOf(formatScene(scene)), scene);
}

TEST(MaterialLook, FollowsTheMaterialThatIsSetAndStaysWhenItIsTuned) {
  Scene scene = sceneOf(R"({"cloth": {}, "render": {"gloss": 0.6}})");
  setSceneValue(scene, "cloth.material=denim");
  EXPECT_EQ(scene.render.weave, "denim");
  EXPECT_EQ(scene.render.gloss, 0.6);
  setSceneValue(scene, "cloth.material.bend=2e-5");
  EXPECT_EQ(scene.render.weave, "denim");
}

TEST(FollowLook, KeepsWhatWasChosen) {
  const RenderSettings silk = sceneOf(R"({"cloth": {"material": "silk"}})").render;
  const RenderSettings wool = sceneOf(R"({"cloth": {"material": "wool"}})").render;
  RenderSettings render = silk;
  render.color = {0, 1, 0};
  followLook(render, silk, wool);
  EXPECT_EQ(render.weave, wool.weave);
  EXPECT_EQ(render.gloss, wool.gloss);
  EXPECT_EQ(render.color, (Vec3d{0, 1, 0}));
}

TEST(LookOf, IsThatOfEachClothsOwnMaterial) {
  const Scene scene = sceneOf(R"({"cloths": [{"material": "silk"}, {"material": "denim"}, {}]})");
  EXPECT_EQ(lookOf(scene, 0), usualLook(scene.cloths[0]));
  EXPECT_EQ(lookOf(scene, 1).weave, "denim");
  EXPECT_EQ(lookOf(scene, 2), RenderSettings{});
}

TEST(LookOf, GivesWayToTheSceneAndThatToTheCloth) {
  const Scene scene = sceneOf(R"({"cloths": [{"material": "silk"},
    {"material": "denim", "render": {"back_color": [0, 1, 0], "texture": "", "thickness": 0.01}}],
    "render": {"weave": "plain", "back_color": [1, 0, 0], "texture": "tartan"}})");
  EXPECT_EQ(lookOf(scene, 0).backColor, (Vec3d{1, 0, 0}));
  const RenderSettings look = lookOf(scene, 1);
  EXPECT_EQ(look.weave, "plain");
  EXPECT_EQ(look.backColor, (Vec3d{0, 1, 0}));
  EXPECT_EQ(look.texture, "");
  EXPECT_EQ(look.thickness, 0.01);
  EXPECT_EQ(look.color, usualLook(scene.cloths[1]).color);
  EXPECT_EQ(sceneOf(formatScene(scene)), scene);
}

TEST(LookOf, IsSetByPath) {
  Scene scene = sceneOf(R"({"cloth": {}, "sphere": {}})");
  setSceneValue(scene, "cloth.render.gloss=0.9");
  setSceneValue(scene, "sphere.render.color=[0, 0, 1]");
  EXPECT_EQ(lookOf(scene, 0).gloss, 0.9);
  EXPECT_EQ(std::get<Sphere>(scene.colliders[0]).render.color, (Vec3d{0, 0, 1}));
}

}  // namespace
}  // namespace clothsim
