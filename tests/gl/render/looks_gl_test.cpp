// Looks of single cloths and colliders.
#include <gtest/gtest.h>

#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"

namespace clothsim {
namespace {

// A glossy red ball and a matte green box on a yellow plane, a sheet of denim over the ball and one of tartan
// beside it.
Scene manyLooks() {
  Scene scene = test::drapeScene();
  scene.render.shader = "fabric";
  scene.render.smooth = false;
  scene.camera.position = Vec3d{1.3, 1.25, 2.3};
  scene.camera.target = Vec3d{0.75, 0.42, 0.5};
  ClothSettings& denim = scene.cloths[0];
  denim.numWidthPoints = denim.numHeightPoints = 32;
  denim.render.weave = "denim";
  denim.render.color = Vec3d{0.05, 0.1, 0.3};
  denim.render.backColor = Vec3d{0.8, 0.8, 0.7};
  denim.render.threadSpacing = 0.02;
  ClothSettings& tartan = scene.cloths.emplace_back(denim);
  tartan.render = {};
  tartan.render.texture = "tartan";
  tartan.render.textureRepeat = 2;
  scene.colliders.clear();
  Sphere ball;
  ball.origin = {1.35, 0.25, 0.9};
  ball.radius = 0.2;
  ball.render = {.color = Vec3d{0.7, 0.05, 0.05}, .gloss = 0.9};
  Box box;
  box.origin = {1.4, 0.15, 0.3};
  box.size = {0.24, 0.24, 0.24};
  box.render = {.color = Vec3d{0.1, 0.5, 0.2}, .gloss = 0};
  Plane plane;
  plane.render.color = Vec3d{0.8, 0.65, 0.2};
  scene.colliders = {ball, box, plane};
  return scene;
}

Image drawn(const Scene& scene) {
  test::Drape drape(scene);
  const Piece& second = drape.cloth.pieces()[1];
  for (std::uint32_t i = second.firstParticle; i < second.firstParticle + second.particleCount(); ++i) {
    drape.positions[i].x += 0.35f;
    drape.positions[i].y -= 0.2f;
    drape.positions[i].z -= 0.75f;
  }
  const gl::Buffer<Particle4> positions("positions", drape.positions);
  Renderer renderer(drape.cloth, drape.scene, {});
  return renderImage(renderer, positions.name(), Camera(drape.scene, drape.cloth), 0, 160, 120);
}

double difference(const Scene& scene) { return test::differenceFromReference("looks", drawn(scene)); }

class Looks : public GlTest {};

TEST_F(Looks, AreTheStoredOnes) { EXPECT_LT(difference(manyLooks()), test::TOLERANCE); }

TEST_F(Looks, OfOneClothMoreOrLessAreSeen) {
  for (const std::size_t cloth : {0, 1}) {
    Scene scene = manyLooks();
    scene.cloths[cloth].render = {};
    EXPECT_GT(test::meanDifference(drawn(scene), drawn(manyLooks())), test::TOLERANCE) << cloth;
  }
}

// Pieces that are drawn one by one, since one differs by what this model does not show, look as all at once.
TEST_F(Looks, OfSinglePiecesAreThoseOfAll) {
  Scene together = manyLooks();
  for (ClothSettings& cloth : together.cloths) cloth.render = {};
  together.render.shader = "diffuse";
  Scene apart = together;
  apart.cloths[1].render.gloss = 0.9;
  EXPECT_EQ(drawn(apart).rgb, drawn(together).rgb);
}

void expectBroken(const std::string& file, const std::string& from, const std::string& to) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change(file, from, to)) << file << " has changed: so must this test";
  const test::CommandResult result = resources.runTests("Looks.AreTheStoredOnes");
  EXPECT_NE(result.output.find("FAILED  ] Looks.AreTheStoredOnes"), std::string::npos) << result.output;
}

TEST(BrokenLook, SolidsOfOneColourAreSeen) {
  expectBroken("render/sphere.frag", "look.rgb * diffuseLight", "vec3(0.6) * diffuseLight");
}
TEST(BrokenLook, PlanesInTheColourOfTheGroundAreSeen) {
  expectBroken("render/plane.frag", "bool isGround = look.r < 0.0", "bool isGround = look.r < 2.0");
}

}  // namespace
}  // namespace clothsim
