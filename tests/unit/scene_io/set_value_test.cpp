// --set key=value
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/cloth_name.h"
#include "scene_io/describe.h"
#include "scene_io/scene_io.h"
#include "support/scene_text.h"

namespace clothsim {
namespace {

using test::sceneOf;

Scene plain() { return sceneOf(R"({"cloth": {"ks": 5000}})"); }
Scene withColliders() {
  return sceneOf(
      R"({"cloth": {}, "colliders": [{"type": "plane"}, {"type": "sphere"}, {"type": "sphere", "radius": 9}]})");
}

Scene changed(Scene scene, const std::string& keyEqualsValue) {
  setSceneValue(scene, keyEqualsValue);
  return scene;
}

std::string messageOf(const Scene& scene, const std::string& keyEqualsValue) {
  Scene copy = scene;
  try {
    setSceneValue(copy, keyEqualsValue);
  } catch (const SceneError& error) {
    EXPECT_EQ(copy, scene) << "a wrong value must leave the scene as it was";
    return error.what();
  }
  return "no SceneError";
}

TEST(SetSceneValue, TakesJsonAndBareWords) {
  EXPECT_EQ(changed(plain(), "cloth.damping=0.5").cloths[0].damping, 0.5);
  EXPECT_EQ(changed(plain(), "cloth.num_width_points=64").cloths[0].numWidthPoints, 64);
  EXPECT_FALSE(changed(plain(), "cloth.enable_bending=false").cloths[0].enableBending);
  EXPECT_EQ(changed(plain(), "solver.integrator=euler").solver.integrator, Integrator::euler);
  EXPECT_EQ(changed(plain(), "solver.integrator=\"euler\"").solver.integrator, Integrator::euler);
  EXPECT_EQ(changed(plain(), "gravity=[0, -1, 0]").gravity, (Vec3d{0, -1, 0}));
  EXPECT_EQ(changed(plain(), "gravity.1=-1").gravity, (Vec3d{0, -1, 0}));
  EXPECT_EQ(changed(plain(), "solver.strain_limit=false").solver.strainLimit, std::nullopt);
  EXPECT_EQ(changed(plain(), "name=a = b").name, "a = b");
  EXPECT_EQ(changed(plain(), "name=").name, "");
}

TEST(SetSceneValue, ChangesNothingElse) {
  Scene expected = loadSceneByName("cs171");
  const Scene scene = changed(expected, "cloth.damping=0.25");
  expected.cloths[0].damping = 0.25;
  EXPECT_EQ(scene, expected);
}

TEST(SetSceneValue, MakesObjectsThatWereAbsent) {
  EXPECT_EQ(changed(plain(), "wind.gust.strength=2").wind->gust.strength, 2);
  EXPECT_TRUE(changed(plain(), "wind={}").wind.has_value());
}

TEST(SetSceneValue, ChangesOneNumberOfAVectorThatIsAtItsDefault) {
  EXPECT_EQ(changed(plain(), "gravity.0=3").gravity, (Vec3d{3, -9.8, 0}));
  EXPECT_EQ(changed(plain(), "cloth.position.1=2").cloths[0].position, (Vec3d{0, 2, 0}));
  EXPECT_EQ(std::get<Sphere>(changed(withColliders(), "colliders.1.origin.2=2").colliders[1]).origin,
            (Vec3d{0, 0, 2}));
  EXPECT_EQ(messageOf(plain(), "camera.position.0=1"),
            "--set camera.position.0=1: camera.position: has no entries to change; set the whole of it");
  EXPECT_NE(
      messageOf(plain(), "cloth.pinned.0=top").find("expected the number of an entry, but the list is empty"),
      std::string::npos);
}

TEST(SetSceneValue, TakesClothForTheFirstCloth) {
  const Scene two = sceneOf(R"({"cloths": [{"ks": 1}, {"ks": 2}]})");
  EXPECT_EQ(changed(two, "cloth.ks=3").cloths[0].ks, 3);
  EXPECT_EQ(changed(two, "cloths.1.ks=3").cloths[1].ks, 3);
  EXPECT_EQ(changed(two, "cloths.1.ks=3").cloths[0].ks, 1);
}

TEST(SetSceneValue, TakesTheNameThatMessagesGiveACloth) {
  EXPECT_EQ(nameOfCloth(plain(), 0), "cloth");
  const Scene two = sceneOf(R"({"cloths": [{"ks": 1}, {"ks": 2}]})");
  EXPECT_EQ(nameOfCloth(two, 0), "cloths.0");
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(changed(two, nameOfCloth(two, i) + ".ks=3").cloths[i].ks, 3);
}

TEST(SetSceneValue, TakesSphereAndPlaneForTheFirstColliderOfThatType) {
  EXPECT_EQ(std::get<Sphere>(changed(withColliders(), "sphere.radius=4").colliders[1]).radius, 4);
  EXPECT_EQ(std::get<Plane>(changed(withColliders(), "plane.friction=1").colliders[0]).friction, 1);
  EXPECT_EQ(std::get<Sphere>(changed(withColliders(), "colliders.2.friction=0").colliders[2]).friction, 0);
}

TEST(SetSceneValue, AddsASphereOrPlaneWhereThereIsNone) {
  const Scene scene = changed(plain(), "sphere={\"radius\": 3}");
  ASSERT_EQ(scene.colliders.size(), 1U);
  EXPECT_EQ(std::get<Sphere>(scene.colliders[0]).radius, 3);
  EXPECT_NE(
      messageOf(plain(), "plane.friction=1").find("the scene has no plane; add one with --set 'plane={}'"),
      std::string::npos);
}

TEST(SetSceneValue, ReplacesPins) {
  const Scene scene = changed(plain(), "cloth.pinned=[\"top\", [3, 4]]");
  EXPECT_EQ(scene.cloths[0].pinned, (std::vector<Pin>{GridSide::top, GridPoint{3, 4}}));
}

TEST(SetSceneValue, TakesKeysBackToTheirDefaultWithNull) {
  Scene scene = sceneOf(R"({"cloth": {"damping": 1}, "wind": {}, "sphere": {}})");
  for (const std::string key : {"cloth.damping", "wind", "sphere"}) setSceneValue(scene, key + "=null");
  EXPECT_EQ(scene, sceneOf(R"({"cloth": {}})"));
}

TEST(SetSceneValue, ChangesTheModelByNullAndTheOtherKey) {
  EXPECT_NE(messageOf(plain(), "cloth.stiffness_reference=40").find("found both ks and stiffness_reference"),
            std::string::npos);
  const Scene scene =
      changed(changed(loadSceneByName("cs171"), "cloth.stiffness_reference=null"), "cloth.ks=100");
  EXPECT_EQ(scene.cloths[0].ks, 100);
  EXPECT_EQ(scene.solver.strainLimit, 0.1);  // as in any scene with ks that says nothing else
}

TEST(SetSceneValue, LetsKeysWithoutPositionFollowTheCollider) {
  const Scene scene = changed(sceneOf(R"({"cloth": {}, "sphere": {"motion": {"keys": [{"t": 0}]}}})"),
                              "sphere.origin=[1, 2, 3]");
  EXPECT_EQ(std::get<Sphere>(scene.colliders[0]).motion->keys[0].position, (Vec3d{1, 2, 3}));
}

TEST(SetSceneValue, ChangesThePathOfPins) {
  const Scene scene = sceneOf(
      R"({"cloth": {"pinned": ["left", "right"], "pin_motion": {"keys": [{"t": 0}, {"t": 1, "position": [1, 2, 3]}]}}})");
  EXPECT_TRUE(changed(scene, "cloth.pin_motion.loop=true").cloths[0].pinMotion[0].loop);
  EXPECT_EQ(changed(scene, "cloth.pin_motion.keys.1.position.0=7").cloths[0].pinMotion[0].keys[1].position,
            (Vec3d{7, 2, 3}));
  EXPECT_TRUE(changed(scene, "cloth.pin_motion=null").cloths[0].pinMotion.empty());
  const Scene two = changed(
      scene,
      R"(cloth.pin_motion=[{"pinned": ["left"], "keys": [{"t": 0}]}, {"pinned": ["right"], "keys": [{"t": 0}]}])");
  ASSERT_EQ(two.cloths[0].pinMotion.size(), 2U);
  EXPECT_TRUE(changed(two, "cloth.pin_motion.1.loop=false").cloths[0].pinMotion == two.cloths[0].pinMotion);
  EXPECT_EQ(changed(two, "cloth.pin_motion.1.keys.0.t=4").cloths[0].pinMotion[1].keys[0].t, 4);
  EXPECT_EQ(
      messageOf(two, "cloth.pin_motion.1.pinned=[\"top\"]"),
      "--set cloth.pin_motion.1.pinned=[\"top\"]: cloth.pin_motion.1.pinned.0: expected each pin in one "
      "motion, found [0, 0] in pin_motion.0, too");
}

TEST(SetSceneValue, MakesTheSameChecksAsTheReader) {
  EXPECT_EQ(messageOf(plain(), "cloth.ks=stiff"),
            "--set cloth.ks=stiff: cloth.ks: expected a number > 0, found \"stiff\"");
  EXPECT_EQ(messageOf(plain(), "cloth.damping=101"),
            "--set cloth.damping=101: cloth.damping: expected a number from 0 to 100, found 101");
  EXPECT_EQ(
      messageOf(withColliders(), "sphere.friction=2"),
      "--set sphere.friction=2: sphere.friction: expected a number from 0 to 1, found 2; larger ones are "
      "Coulomb's coefficient and need \"friction_law\": \"coulomb\" in solver");
  EXPECT_EQ(messageOf(plain(), "cloth.ks=1e999"),
            "--set cloth.ks=1e999: cloth.ks: expected a number > 0, found \"1e999\"");
  EXPECT_NE(messageOf(plain(), "cloth.pinned=[[50, 0]]").find("expected [column, row] on the grid"),
            std::string::npos);
}

TEST(SetSceneValue, OffersTheNearestKey) {
  EXPECT_EQ(messageOf(plain(), "cloth.dampng=1"),
            "--set cloth.dampng=1: cloth.dampng: unknown key; did you mean \"damping\"?");
  EXPECT_EQ(messageOf(plain(), "solvr.integrator=euler"),
            "--set solvr.integrator=euler: solvr: unknown key; did you mean \"solver\"?");
  EXPECT_EQ(messageOf(plain(), "damping=1"),
            "--set damping=1: damping: unknown key; it belongs to cloth.damping");
}

TEST(SetSceneValue, OfDensityAndMassKeepsTheOneThatIsSet) {
  Scene scene = loadSceneByName("cs171");
  setSceneValue(scene, "cloth.density=0.5");
  EXPECT_FALSE(scene.cloths[0].mass.has_value());
  EXPECT_EQ(scene.cloths[0].density, 0.5);
  setSceneValue(scene, "cloth.mass=2");
  EXPECT_EQ(scene.cloths[0].mass, 2);
  EXPECT_EQ(scene.cloths[0].density, ClothSettings{}.density);
}

TEST(SetSceneValue, RefusesPathsThatLeadNowhere) {
  EXPECT_NE(messageOf(plain(), "cloths.1.ks=3")
                .find("cloths: expected the number of an entry, 0 to 0, found \"1\""),
            std::string::npos);
  EXPECT_NE(messageOf(plain(), "cloth.ks.value=3").find("cloth.ks: expected an object"), std::string::npos);
  EXPECT_NE(messageOf(withColliders(), "colliders.first.friction=0").find("found \"first\""),
            std::string::npos);
  for (const std::string wrong : {"cloth..ks=3", ".ks=3", "cloth.=3", "comment=3", "cloth.//=3"})
    EXPECT_NE(messageOf(plain(), wrong).find("is not a key that can be set"), std::string::npos) << wrong;
}

TEST(SetSceneValue, RefusesTextWithoutAnEqualsSignAsWrongUsage) {
  Scene scene = plain();
  EXPECT_THROW(setSceneValue(scene, "cloth.ks"), UsageError);
  EXPECT_THROW(setSceneValue(scene, "=3"), UsageError);
}

TEST(SetSceneValue, RefusesBytesThatAreNoText) {
  EXPECT_NE(messageOf(plain(), "name=caf\xe9").find("not valid UTF-8"), std::string::npos);
}

// Every plain key of describe can be set to its own default.
TEST(SetSceneValue, KnowsEveryKeyOfTheTable) {
  int tried = 0;
  for (const FieldInfo& field : describeFields()) {
    const bool plainValue =
        field.defaultValue.find_first_of("{ ") == std::string::npos || field.defaultValue[0] == '[';
    if (field.path.find("[]") != std::string::npos || field.defaultValue.empty() || !plainValue) continue;
    if (field.defaultValue == "none" || field.defaultValue == "required" || field.path.starts_with("expect"))
      continue;
    EXPECT_NO_THROW((void)changed(plain(), field.path + "=" + field.defaultValue)) << field.path;
    ++tried;
  }
  EXPECT_GT(tried, 30);
}

}  // namespace
}  // namespace clothsim
