// The orbit camera and what it shows of the bundled scenes. Needs no context.
#include "render/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/stage.h"
#include "scene/scene_io.h"

namespace clothsim {
namespace {

constexpr double wide = 16.0 / 9.0;

glm::vec2 onScreen(const Camera& camera, glm::vec3 point) {
  const glm::vec4 clip = camera.projection(wide) * camera.view() * glm::vec4(point, 1);
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

TEST_P(BundledFraming, ShowsAllOfTheClothBeforeItFallsAndEverySphere) {
  const Scene scene = withoutCamera(GetParam());
  const Cloth cloth(scene);
  const Camera camera(scene, cloth);
  const auto expectShown = [&](glm::vec3 point) {
    const glm::vec2 place = onScreen(camera, point);
    EXPECT_LT(std::abs(place.x), 1) << GetParam();
    EXPECT_LT(std::abs(place.y), 1) << GetParam();
  };
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) expectShown(restPlace(cloth, i));
  for (const Collider& collider : scene.colliders) {
    const auto* sphere = std::get_if<Sphere>(&collider);
    if (sphere == nullptr) continue;
    const auto radius = static_cast<float>(sphere->radius);
    for (const glm::vec3 side : {glm::vec3(radius, 0, 0), glm::vec3(0, radius, 0), glm::vec3(0, 0, radius)}) {
      expectShown(toGlm(sphere->origin) + side);
      expectShown(toGlm(sphere->origin) - side);
    }
  }
}

TEST_P(BundledFraming, LooksFromSlightlyAboveAndNotFromFarAway) {
  const Scene scene = withoutCamera(GetParam());
  const Cloth cloth(scene);
  const Camera camera(scene, cloth);
  EXPECT_GT(camera.eye().y, camera.target().y);
  Bounds seen;  // on the screen
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    seen.add(glm::vec3(onScreen(camera, restPlace(cloth, i)), 0));
  EXPECT_GT(std::max(seen.size().x, seen.size().y), 0.8f) << "the sheet spans less than 40 % of the picture";
}

std::vector<std::string> bundledNames() {
  std::vector<std::string> names;
  for (const BundledScene& scene : bundledScenes()) names.push_back(scene.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, BundledFraming, ::testing::ValuesIn(bundledNames()),
                         [](const auto& name) { return name.param; });

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
