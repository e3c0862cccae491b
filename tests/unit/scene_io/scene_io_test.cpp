#include "scene_io/scene_io.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

const fs::path cs184 = fs::path(TEST_DATA) / "data" / "cs184";

Scene parse(const std::string& text) { return parseScene(text, "test"); }

ClothSettings cs184Cloth() {
  ClothSettings cloth;
  cloth.ks = 5000;
  return cloth;
}

Scene cs184Scene() {
  Scene scene;
  scene.cloths = {cs184Cloth()};
  scene.solver.strainLimit = 0.1;
  scene.solver.selfCollision = SelfCollision::averaged;
  return scene;
}

// The expected values are those of CS184's files and, for what the files leave out, of CS184's program.
TEST(Cs184Files, Pinned2Loads) {
  Scene expected = cs184Scene();
  expected.cloths[0].pinned = {GridPoint{0, 0}, GridPoint{49, 0}};
  EXPECT_EQ(loadScene(cs184 / "pinned2.json"), expected);
}

TEST(Cs184Files, Pinned4Loads) {
  Scene expected = cs184Scene();
  expected.cloths[0].pinned = {GridPoint{0, 0}, GridPoint{0, 49}, GridPoint{49, 0}, GridPoint{49, 49}};
  EXPECT_EQ(loadScene(cs184 / "pinned4.json"), expected);
}

TEST(Cs184Files, PlaneLoads) {
  Scene expected = cs184Scene();
  expected.colliders = {Plane{{0, 0, 0}, {0, 1, 0}, 0.5, std::nullopt}};
  EXPECT_EQ(loadScene(cs184 / "plane.json"), expected);
}

TEST(Cs184Files, SphereLoads) {
  Scene expected = cs184Scene();
  expected.colliders = {Sphere{{0.5, 0.2, 0.5}, 0.2, 0.3, std::nullopt}};
  EXPECT_EQ(loadScene(cs184 / "sphere.json"), expected);
}

TEST(Cs184Files, SelfCollisionLoads) {
  Scene expected = cs184Scene();
  expected.cloths[0].orientation = Orientation::vertical;
  expected.colliders = {Plane{{0, 0, 0}, {0, 1, 0}, 0.5, std::nullopt}};
  EXPECT_EQ(loadScene(cs184 / "selfCollision.json"), expected);
}

TEST(BundledScenes, OfCs184sNamesHaveCs184sPhysics) {
  for (const std::string name : {"pinned2", "pinned4", "plane", "sphere", "selfCollision"}) {
    Scene bundled = loadSceneByName(name);
    EXPECT_EQ(bundled.name, name);
    EXPECT_FALSE(bundled.description.empty());
    const Scene original = loadScene(cs184 / (name + ".json"));
    bundled.name = bundled.description = "";
    bundled.camera = {};
    bundled.expect.reset();
    bundled.render = {};
    EXPECT_EQ(bundled, original) << name;
  }
}

TEST(BundledScenes, Cs171HasTheNumbersOfTheAssignment) {
  const Scene scene = loadSceneByName("cs171");
  const ClothSettings& cloth = scene.cloths.at(0);
  EXPECT_EQ(cloth.numWidthPoints, 40);
  EXPECT_EQ(cloth.numHeightPoints, 30);
  EXPECT_NEAR(cloth.width / 39, 0.1, 1e-15);
  EXPECT_NEAR(cloth.height / 29, 0.1, 1e-15);
  EXPECT_EQ(cloth.mass, 1);
  EXPECT_EQ(cloth.ks, std::nullopt);
  EXPECT_EQ(cloth.stiffnessReference, 40);
  EXPECT_EQ(cloth.damping, 0);
  EXPECT_TRUE(cloth.enableStructural && cloth.enableShearing && !cloth.enableBending);
  EXPECT_EQ(cloth.pinned, (std::vector<Pin>{GridPoint{0, 0}, GridPoint{39, 0}}));
  EXPECT_EQ(scene.airResistance, 0.001);
  EXPECT_EQ(scene.gravity, (Vec3d{0, -9.8, 0}));
  EXPECT_EQ(scene.solver.integrator, Integrator::euler);
  EXPECT_EQ(scene.solver.strainLimit, std::nullopt);
  EXPECT_EQ(scene.solver.selfCollision, SelfCollision::off);
  EXPECT_NEAR(stepLength(scene.solver), 0.002, 1e-15);
}

TEST(BundledScenes, AreListedByNameWithADescription) {
  const std::vector<BundledScene> scenes = bundledScenes();
  EXPECT_GE(scenes.size(), 6U);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    EXPECT_FALSE(scenes[i].description.empty()) << scenes[i].name;
    EXPECT_TRUE(fs::exists(scenes[i].thumbnail))
        << scenes[i].thumbnail << "; tools/gallery Thumbnails makes it";
    EXPECT_EQ(loadSceneByName(scenes[i].name), loadScene(scenes[i].path));
    EXPECT_TRUE(i == 0 || scenes[i - 1].name < scenes[i].name) << scenes[i].name;
  }
}

TEST(SceneFilesIn, ListsJsonThatMentionsACloth) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "b.json", "{\"cloth\": {}}");
  writeFileAtomically(folder / "a.json", "{\"cloths\": [{}]}");
  writeFileAtomically(folder / "recording.json",
                      R"({"schema": "clothsim-recording/1", "scene": {"cloth": {}}})");
  writeFileAtomically(folder / "settings.json", R"({"clothsim": 1})");
  writeFileAtomically(folder / "notes.txt", "\"cloth\"");
  fs::create_directory(folder / "c.json");
  EXPECT_EQ(sceneFilesIn(folder.path()), (std::vector<std::string>{"a.json", "b.json"}));
  EXPECT_TRUE(sceneFilesIn(folder / "nowhere").empty());
}

TEST(LoadSceneByName, OffersTheNearestBundledScene) {
  try {
    (void)loadSceneByName("sphre");
    FAIL() << "no SceneError";
  } catch (const SceneError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("\"sphre\"; did you mean \"sphere\"?"), std::string::npos) << message;
    EXPECT_NE(message.find("pinned2, pinned4, plane"), std::string::npos) << message;
  }
}

TEST(LoadSceneByName, TakesASlashOrAJsonEndingForAPath) {
  EXPECT_EQ(loadSceneByName((cs184 / "plane.json").string()), loadScene(cs184 / "plane.json"));
  for (const std::string path : {"./pinned2", "pinned2.json"}) {
    try {
      (void)loadSceneByName(path);
      FAIL() << "no SceneError for " << path;
    } catch (const SceneError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(path + ": no such file")) << error.what();
    }
  }
}

TEST(ParseScene, GivesKsScenesTheLimiterAndSelfCollisionOfCs184) {
  for (const std::string text : {R"({"cloth": {"ks": 10}})", R"({"cloth": {}})"}) {
    const Scene scene = parse(text);
    EXPECT_EQ(scene.solver.strainLimit, 0.1);
    EXPECT_EQ(scene.solver.selfCollision, SelfCollision::averaged);
  }
  EXPECT_EQ(parse(R"({"cloth": {}})").cloths[0].ks, 5000);
}

TEST(ParseScene, GivesStiffnessReferenceScenesNeither) {
  const Scene scene = parse(R"({"cloth": {"stiffness_reference": 40}})");
  EXPECT_EQ(scene.cloths[0].ks, std::nullopt);
  EXPECT_EQ(scene.solver.strainLimit, std::nullopt);
  EXPECT_EQ(scene.solver.selfCollision, SelfCollision::off);
}

TEST(ParseScene, LetsAKsSceneSwitchBothOffAndOthersOn) {
  const Scene ks =
      parse(R"({"cloth": {"ks": 1}, "solver": {"strain_limit": false, "self_collision": false}})");
  EXPECT_EQ(ks.solver.strainLimit, std::nullopt);
  EXPECT_EQ(ks.solver.selfCollision, SelfCollision::off);
  const Scene other = parse(
      R"({"cloth": {"stiffness_reference": 1}, "solver": {"strain_limit": 0.2, "self_collision": true}})");
  EXPECT_EQ(other.solver.strainLimit, 0.2);
  EXPECT_EQ(other.solver.selfCollision, SelfCollision::robust);
}

TEST(ParseScene, ReadsSelfCollisionByName) {
  const auto mode = [](const std::string& cloth, const std::string& value) {
    return parse(R"({"cloth": {)" + cloth + R"(}, "solver": {"self_collision": )" + value + "}}")
        .solver.selfCollision;
  };
  EXPECT_EQ(mode("", "true"), SelfCollision::averaged);
  EXPECT_EQ(mode("", "\"robust\""), SelfCollision::robust);
  EXPECT_EQ(mode(R"("stiffness_reference": 1)", "true"), SelfCollision::robust);
  EXPECT_EQ(mode(R"("stiffness_reference": 1)", "\"averaged\""), SelfCollision::averaged);
}

TEST(ParseScene, ReadsAllKindsOfPins) {
  const Scene scene = parse(
      R"({"cloth": {"pinned": [[3, 4], "top", "bottom", "left", "right", {"from": [0, 0], "to": [9, 1]}]}})");
  const std::vector<Pin> expected{GridPoint{3, 4}, GridSide::top,   GridSide::bottom,
                                  GridSide::left,  GridSide::right, GridRange{{0, 0}, {9, 1}}};
  EXPECT_EQ(scene.cloths[0].pinned, expected);
}

TEST(ParseScene, ReadsOrientationAsNumberOrWord) {
  EXPECT_EQ(parse(R"({"cloth": {"orientation": 1}})").cloths[0].orientation, Orientation::vertical);
  EXPECT_EQ(parse(R"({"cloth": {"orientation": "vertical"}})").cloths[0].orientation, Orientation::vertical);
  EXPECT_EQ(parse(R"({"cloth": {"orientation": "horizontal"}})").cloths[0].orientation,
            Orientation::horizontal);
}

TEST(ParseScene, ReadsWholeNumbersWithAPoint) {
  EXPECT_EQ(parse(R"({"cloth": {"num_width_points": 64.0}})").cloths[0].numWidthPoints, 64);
}

TEST(ParseScene, KeepsCollidersInTheOrderPlaneSphereList) {
  const Scene scene = parse(
      R"({"colliders": [{"type": "sphere", "radius": 3}], "sphere": {"radius": 2}, "plane": {}, "cloth": {}})");
  ASSERT_EQ(scene.colliders.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<Plane>(scene.colliders[0]));
  EXPECT_EQ(std::get<Sphere>(scene.colliders[1]).radius, 2);
  EXPECT_EQ(std::get<Sphere>(scene.colliders[2]).radius, 3);
}

TEST(ParseScene, LetsMotionKeysStayAtTheCollidersOwnPlace) {
  const Scene scene = parse(
      R"({"cloth": {}, "sphere": {"motion": {"keys": [{"t": 0}, {"t": 1, "position": [0, 0, 0]}]}, "origin": [1, 2, 3]}})");
  const Motion& motion = *std::get<Sphere>(scene.colliders[0]).motion;
  EXPECT_EQ(motion.keys[0].position, (Vec3d{1, 2, 3}));
  EXPECT_EQ(motion.keys[1].position, (Vec3d{0, 0, 0}));
}

TEST(ParseScene, PassesOverComments) {
  const Scene scene = parse(R"({"comment": "a", "// b": [1], "//": 2, "//": 3,
    "cloth": {"comment": {"c": 1}, "ks": 5}, "colliders": [{"//": 1, "type": "plane"}]})");
  EXPECT_EQ(scene.cloths[0].ks, 5);
  EXPECT_EQ(scene.colliders.size(), 1U);
}

TEST(ParseScene, AcceptsAByteOrderMarkAndWindowsLineEnds) {
  const Scene scene = parse("\xEF\xBB\xBF{\r\n\"cloth\": {\r\n\"ks\": 5\r\n}\r\n}\r\n");
  EXPECT_EQ(scene.cloths[0].ks, 5);
}

TEST(SaveScene, WritesAFileThatLoadsTheSame) {
  const test::TemporaryFolder folder;
  const Scene scene = loadSceneByName("cs171");
  saveScene(scene, folder / "copy.json");
  EXPECT_EQ(loadScene(folder / "copy.json"), scene);
}

TEST(SaveScene, SaysWhenItCannotWrite) {
  EXPECT_THROW(saveScene(Scene{}, "/nonexistent/folder/a.json"), InputOutputError);
}

TEST(LoadSceneByName, SaysWhichMeshesAreRead) {
  for (const std::string name : {"cloth.ply", "a/cloth.USDC", "cloth.glb"}) try {
      (void)loadSceneByName(name);
      ADD_FAILURE() << name;
    } catch (const SceneError& error) {
      EXPECT_TRUE(
          std::string(error.what()).starts_with(name + ": expected a scene (.json) or a mesh as .obj"))
          << error.what();
    }
}

}  // namespace
}  // namespace clothsim
