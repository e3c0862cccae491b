// The orbit camera and what it shows of the bundled scenes. Needs no context.
#include "render/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/stage.h"
#include "scene/pose.h"
#include "scene_io/scene_io.h"
#include "simulation/simulation.h"

namespace clothsim {
namespace {

constexpr double wide = 16.0 / 9.0;

glm::vec2 onScreen(const Camera& camera, glm::vec3 point, double aspect = wide) {
  const glm::vec4 clip = camera.projection(aspect) * camera.view() * glm::vec4(point, 1);
  return glm::vec2(clip) / clip.w;
}

glm::vec3 restPlace(const Cloth& cloth, std::uint32_t particle) { return toGlm(cloth.positions()[particle]); }

// The scene as a user's own would be who has not thought of a camera yet.
Scene withoutCamera(const std::string& name) {
  Scene scene = loadSceneByName(name);
  scene.camera = {};
  return scene;
}

class BundledFraming : public ::testing::TestWithParam<std::string> {};

// One test: reading the scenes takes longer than looking at them.
TEST_P(BundledFraming, ShowsAllOfTheClothAndEverySphereFromSlightlyAboveAndNotFromFarAway) {
  const Scene scene = withoutCamera(GetParam());
  const Cloth cloth(scene);
  const Camera camera(scene, cloth), upright = pictureCamera(scene, cloth, 160, 320);
  Bounds seen;  // on the screen
  const auto expectShown = [&](glm::vec3 point) {
    const glm::vec2 place = onScreen(camera, point);
    EXPECT_LT(std::max(std::abs(place.x), std::abs(place.y)), 1);
    return place;
  };
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    seen.add(glm::vec3(expectShown(restPlace(cloth, i)), 0));
    EXPECT_LT(std::abs(onScreen(upright, restPlace(cloth, i), 0.5).x), 1);
  }
  for (const Collider& collider : scene.colliders) {
    const auto* sphere = std::get_if<Sphere>(&collider);
    if (sphere == nullptr) continue;
    const auto radius = static_cast<float>(sphere->radius);
    for (const glm::vec3 side : {glm::vec3(radius, 0, 0), glm::vec3(0, radius, 0), glm::vec3(0, 0, radius)}) {
      expectShown(toGlm(sphere->origin) + side);
      expectShown(toGlm(sphere->origin) - side);
    }
  }
  EXPECT_GT(camera.eye().y, camera.target().y);
  const float least = GetParam() == "walk" ? 0.6f : 0.8f;  // a figure three times as high as its skirt
  EXPECT_GT(std::max(seen.size().x, seen.size().y), least)
      << "the sheet spans less than " << 50 * least << " % of the picture";
}

INSTANTIATE_TEST_SUITE_P(All, BundledFraming, ::testing::ValuesIn(bundledNames()),
                         [](const auto& name) { return name.param; });

TEST(PictureCamera, StandsWhereTheScenePutsIt) {
  const Scene scene = loadSceneByName("demo");
  const glm::vec3 eye = pictureCamera(scene, Cloth(scene), 160, 320).eye();
  EXPECT_LT(glm::distance(eye, toGlm(*scene.camera.position)), 1e-5f);
}

// How far from the middle of the picture cloth and spheres come at the ends of frames; 1 is its edge.
float farthestFromMiddle(Scene scene, double time) {
  if (!scene.cloths[0].isMesh()) (void)changeResolution(scene, 9, 9, true);
  Simulation simulation(scene, "cpu");
  const Camera camera(scene, simulation.cloth());
  float farthest = 0;
  const auto look = [&](glm::vec3 point) {
    const glm::vec2 place = glm::abs(onScreen(camera, point));
    farthest = std::max({farthest, place.x, place.y});
  };
  for (int frame = 0; simulation.time() < time; ++frame) {
    if (frame > 0) simulation.stepFrame();
    for (const Particle4& p : simulation.solver().state().positions) look({p.x, p.y, p.z});
    for (const Collider& collider : scene.colliders) {
      const auto* sphere = std::get_if<Sphere>(&collider);
      if (sphere == nullptr) continue;
      const glm::vec3 middle = toGlm(poseAt(collider, simulation.time()).position);
      for (const double side : {-sphere->radius, sphere->radius})
        look(middle + glm::vec3(0, static_cast<float>(side), 0));
    }
  }
  return farthest;
}

TEST(AutomaticCamera, KeepsClothThatSwingsInThePicture) {
  EXPECT_LT(farthestFromMiddle(withoutCamera("pinned2"), 1), 1);
  EXPECT_LT(farthestFromMiddle(withoutCamera("cs171"), 2), 1) << "it stretches, too";
}

const char* const standing = R"({"cloth": {"num_width_points": 9, "num_height_points": 9, "orientation": 1,
                                            "ks": 500, "density": 1.5, "pinned": ["top"])";

TEST(AutomaticCamera, KeepsClothInTheWindInThePicture) {
  const Scene scene = parseScene(std::string(standing) + R"(}, "wind": {"velocity": [0, 0, 9]}})", "flag");
  EXPECT_LT(farthestFromMiddle(scene, 2), 1);
}

// A floor 1.5 m below, alone, under a ball beside the cloth, and under a box that only one of two cloths
// stays on.
TEST(AutomaticCamera, KeepsClothThatFallsToTheFloorInThePicture) {
  const std::string sheet = R"({"width": 0.5, "height": 0.5, "num_width_points": 9, "num_height_points": 9,
                                "material": "cotton", "position": [)";
  const std::string first = R"({"cloths": [)" + sheet + "-0.25, 0.5, -0.25]}",
                    floor = R"("colliders": [{"type": "plane", "friction": 0.5})";
  const Scene alone = parseScene(first + "], " + floor + "]}", "alone"),
              beside = parseScene(
                  first + "], " + floor + R"(, {"type": "sphere", "origin": [0.6, 1.2, 0], "radius": 0.2}]})",
                  "beside"),
              two = parseScene(first + ", " + sheet + "0.5, 0.5, -0.25]}], " + floor +
                                   R"(, {"type": "box", "origin": [0, 1, 0], "size": [0.3, 0.3, 0.3]}]})",
                               "two");
  for (const Scene& scene : {alone, beside, two}) EXPECT_LT(farthestFromMiddle(scene, 1), 1) << scene.name;
}

TEST(AutomaticCamera, KeepsPinsAndSolidsInThePictureAllAlongTheirPaths) {
  const Scene carried = parseScene(std::string(standing) + R"(, "pin_motion": {"keys": [
      {"t": 0}, {"t": 0.7, "position": [3, 2, 1]}, {"t": 1.4, "rotation": [0, 180, 0]}]}}})",
                                   "carried");
  EXPECT_LT(farthestFromMiddle(carried, 1.6), 1);
  const Scene passing =
      parseScene(std::string(standing) + R"(}, "colliders": [{"type": "sphere", "radius": 0.2,
      "motion": {"keys": [{"t": 0, "position": [-3, 0.5, 1]}, {"t": 1, "position": [4, 0.5, 1]}]}}]})",
                 "passing");
  EXPECT_LT(farthestFromMiddle(passing, 1.1), 1);
}

TEST(AutomaticCamera, ShowsStandingClothFromTheFrontWithItsPictureUpright) {
  const Scene scene = parseScene(std::string(standing) + "}}", "standing");
  const Cloth cloth(scene);
  const Camera camera(scene, cloth);
  EXPECT_GT(camera.eye().z, 1) << "CS184's viewer looks from there, too";
  const auto [a, b, c] = cloth.triangles()[0];
  const glm::vec3 normal =
      glm::cross(restPlace(cloth, b) - restPlace(cloth, a), restPlace(cloth, c) - restPlace(cloth, a));
  EXPECT_GT(normal.z, 0) << "its front";
  const auto uv = cloth.textureCoordinates();
  const std::uint32_t lowerLeft = 0, upperRight = 80;
  EXPECT_LT(onScreen(camera, restPlace(cloth, lowerLeft)).x,
            onScreen(camera, restPlace(cloth, upperRight)).x);
  EXPECT_LT(onScreen(camera, restPlace(cloth, lowerLeft)).y,
            onScreen(camera, restPlace(cloth, upperRight)).y);
  EXPECT_EQ(uv[lowerLeft], (std::array{0.0f, 1.0f})) << "v runs down the picture";
  EXPECT_EQ(uv[upperRight], (std::array{1.0f, 0.0f}));
}

TEST(AutomaticCamera, FramesTheSceneInWhatIsLeftFreeOfThePicture) {
  const Scene scene = parseScene(std::string(standing) + "}}", "standing");
  const Cloth cloth(scene);
  const Camera camera(scene, cloth, wide, {.right = 0.4, .bottom = 0.1});
  Bounds seen;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    seen.add(glm::vec3(onScreen(camera, restPlace(cloth, i)), 0));
  EXPECT_LT(seen.high.x, 0.2f) << "the card covers what is to the right of that";
  EXPECT_GT(seen.low.y, -0.8f);
  EXPECT_GT(seen.low.x, -1);
  EXPECT_LT(seen.high.y, 1);
  EXPECT_GT(seen.size().x, 0.4f) << "and it is no smaller than it must be";
}

TEST(AutomaticCamera, LeavesACameraOfTheScenesOwnWhereItIs) {
  Scene scene = parseScene(std::string(standing) + "}}", "standing");
  scene.camera.position = Vec3d{0, 1, 3};
  scene.camera.target = Vec3d{0.5, 0.5, 0};
  const Cloth cloth(scene);
  EXPECT_EQ(Camera(scene, cloth, wide, {.right = 0.4}).eye(), Camera(scene, cloth).eye());
}

TEST(SavedCamera, IsWhereItWasMovedToInThePictureThatWasSeen) {
  for (const char* camera : {"}", R"(, "camera": {"position": [0, 1, 3], "fov": 50}})"}) {
    Scene scene = parseScene(std::string(standing) + "}" + camera, "standing");
    const Cloth cloth(scene);
    Camera moved(scene, cloth);
    moved.setHome(Camera(scene, cloth, 1.2));  // as the viewer does, once it knows its window
    EXPECT_EQ(moved.settings(scene.camera), scene.camera) << "it was not moved";
    moved.orbit(0.4, 0.2);
    moved.zoom(0.7);
    scene.camera = moved.settings(scene.camera);
    const Camera again(scene, cloth, 1.2);
    EXPECT_LT(glm::distance(again.eye(), moved.eye()), 3e-5f);
    EXPECT_LT(glm::distance(again.target(), moved.target()), 3e-5f);
    EXPECT_EQ(again.projection(1.2)[1][1], moved.projection(1.2)[1][1]) << "the field of view stays";
  }
}

class CameraTest : public ::testing::Test {
 protected:
  Scene scene_;
  Cloth cloth_{scene_};
  Camera camera_{scene_, cloth_};
};

TEST_F(CameraTest, StandsWhereTheSceneSays) {
  scene_.camera.position = Vec3d{3, 2, 1};
  scene_.camera.target = Vec3d{0, 1, 0};
  const Camera camera(scene_, cloth_);
  EXPECT_LT(glm::distance(camera.eye(), glm::vec3(3, 2, 1)), 1e-5f);
  EXPECT_LT(glm::length(onScreen(camera, {0, 1, 0})), 1e-5f);
}

TEST_F(CameraTest, OrbitsAtAFixedDistanceAndStopsShortOfThePoles) {
  const float distance = glm::distance(camera_.eye(), camera_.target());
  camera_.orbit(1.0, 50);
  EXPECT_NEAR(glm::distance(camera_.eye(), camera_.target()), distance, 1e-5);
  EXPECT_TRUE(std::isfinite(camera_.view()[0][0]));
  const glm::vec3 direction = glm::normalize(camera_.eye() - camera_.target());
  EXPECT_LT(direction.y, 1.0f);
  EXPECT_GT(direction.y, 0.99f);
}

TEST_F(CameraTest, ZoomScalesTheDistance) {
  const float distance = glm::distance(camera_.eye(), camera_.target());
  camera_.zoom(0.5);
  EXPECT_NEAR(glm::distance(camera_.eye(), camera_.target()), 0.5f * distance, 1e-5);
}

TEST_F(CameraTest, PanMovesThePictureByTheGivenPartOfItsHeight) {
  const glm::vec3 before = camera_.target();
  camera_.pan(0.25, 0.5);
  const glm::vec2 place = onScreen(camera_, before);  // in half heights, y up; x in half widths
  EXPECT_NEAR(place.x, -0.5 / wide, 1e-4);
  EXPECT_NEAR(place.y, -1.0, 1e-4);
}

TEST_F(CameraTest, ResetUndoesEverything) {
  const glm::vec3 eye = camera_.eye();
  camera_.orbit(1, 0.2);
  camera_.pan(0.3, -0.1);
  camera_.zoom(3);
  camera_.reset();
  EXPECT_EQ(camera_.eye(), eye);
}

}  // namespace
}  // namespace clothsim
