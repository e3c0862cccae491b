// Picking: what is found under a pixel is what the picture shows there.
#include "render/picking.h"

#include <cmath>

#include "gl/gl_test.h"
#include "gl/render/picture.h"

namespace clothsim {
namespace {

constexpr int PICKED_WIDTH = 320, PICKED_HEIGHT = 200;

class PickingTest : public GlTest {
 protected:
  struct Stand {
    test::Drape drape;
    gl::Buffer<Particle4> positions;
    Camera camera;
    Renderer renderer;

    explicit Stand(const Scene& scene)
        : drape(scene),
          positions("positions", drape.positions),
          camera(scene, drape.cloth),
          renderer(drape.cloth, scene, {}) {}

    Pick pickAt(double x, double y) {
      return renderer.pick(positions.name(), camera, 0, PICKED_WIDTH, PICKED_HEIGHT, x, y);
    }
    // In pixels from the top left.
    glm::vec2 onScreen(glm::vec3 point) const {
      const glm::vec4 clip = camera.projection(static_cast<double>(PICKED_WIDTH) / PICKED_HEIGHT) *
                             camera.view() * glm::vec4(point, 1);
      return {(0.5f + 0.5f * clip.x / clip.w) * PICKED_WIDTH,
              (0.5f - 0.5f * clip.y / clip.w) * PICKED_HEIGHT};
    }
    glm::vec3 place(std::uint32_t particle) const {
      const Particle4& p = drape.positions[particle];
      return {p.x, p.y, p.z};
    }
  };
};

TEST_F(PickingTest, FindsTheParticleUnderThePixelAndWhereItIs) {
  Stand stand(test::drapeScene());
  const Piece& piece = stand.drape.cloth.pieces()[0];
  for (const auto& [column, row] : {std::pair{24, 24}, {28, 26}, {25, 30}}) {  // on top, in sight
    const std::uint32_t particle = piece.particle(column, row);
    const glm::vec2 pixel = stand.onScreen(stand.place(particle));
    const Pick pick = stand.pickAt(static_cast<double>(pixel.x), static_cast<double>(pixel.y));
    ASSERT_EQ(pick.kind, Pick::Kind::cloth);
    EXPECT_EQ(pick.piece, 0u);
    EXPECT_EQ(pick.particle, particle);
    EXPECT_NEAR(pick.lattice.column, column, 0.01);
    EXPECT_NEAR(pick.lattice.row, row, 0.01);
    EXPECT_LT(glm::distance(pick.point, stand.place(particle)), 1e-4f);
  }
}

TEST_F(PickingTest, InsideATriangleThePlaceIsInItAndThePointOnIt) {
  Stand stand(test::drapeScene());
  const Piece& piece = stand.drape.cloth.pieces()[0];
  const glm::vec3 a = stand.place(piece.particle(24, 26)), b = stand.place(piece.particle(25, 26));
  const glm::vec3 c = stand.place(piece.particle(24, 27));
  const glm::vec3 inside = 0.5f * a + 0.2f * b + 0.3f * c;
  const glm::vec2 pixel = stand.onScreen(inside);
  const Pick pick = stand.pickAt(static_cast<double>(pixel.x), static_cast<double>(pixel.y));
  ASSERT_EQ(pick.kind, Pick::Kind::cloth);
  EXPECT_NEAR(pick.lattice.column, 24.2, 0.02);
  EXPECT_NEAR(pick.lattice.row, 26.3, 0.02);
  EXPECT_LT(glm::distance(pick.point, inside), 1e-4f);
  EXPECT_EQ(pick.particle, piece.particle(24, 26));
}

TEST_F(PickingTest, TellsTheColliderBehindACutInTheCloth) {
  Scene scene = test::drapeScene();
  scene.colliders.emplace(scene.colliders.begin(), Plane{.point = {0, -1, 0}});
  scene.colliders.emplace_back(
      Box{.origin = {1.3, 0.1, 0.5}, .size = {0.2, 0.2, 0.2}, .rotation = {0, 20, 0}});
  Stand stand(scene);
  const glm::vec2 top = stand.onScreen(stand.place(stand.drape.cloth.pieces()[0].particle(24, 26)));
  const auto pickTop = [&] { return stand.pickAt(static_cast<double>(top.x), static_cast<double>(top.y)); };
  EXPECT_EQ(pickTop().kind, Pick::Kind::cloth);

  Cuts cuts;
  for (double row = 20.5; row < 33; ++row) cutAlong(cuts, stand.drape.cloth, 0, {15, row}, {33, row});
  stand.renderer.setCuts(cuts);
  const Pick ball = pickTop();
  EXPECT_EQ(ball.kind, Pick::Kind::collider);
  EXPECT_EQ(ball.collider, 1u);
  EXPECT_NEAR(glm::distance(ball.point, glm::vec3(0.5, 0.5, 0.5)), 0.25, 0.02);
  stand.renderer.setCuts({});
  EXPECT_EQ(pickTop().kind, Pick::Kind::cloth);

  const glm::vec2 box = stand.onScreen({1.3, 0.2, 0.5});
  EXPECT_EQ(stand.pickAt(static_cast<double>(box.x), static_cast<double>(box.y)).collider, 2u);
  const Pick floor = stand.pickAt(20, PICKED_HEIGHT - 10);
  EXPECT_EQ(floor.kind, Pick::Kind::collider);
  EXPECT_EQ(floor.collider, 0u);
  EXPECT_NEAR(floor.point.y, -1, 1e-3);
}

TEST_F(PickingTest, TheFloorOfASceneWithoutPlanesAndTheBackdropAreNothing) {
  Stand stand(test::drapeScene());
  EXPECT_EQ(stand.pickAt(20, PICKED_HEIGHT - 10).kind, Pick::Kind::nothing);
  EXPECT_EQ(stand.pickAt(20, 5).kind, Pick::Kind::nothing);
}

TEST_F(PickingTest, TellsWhichOfTwoSheets) {
  Scene scene = test::drapeScene();
  scene.cloths.push_back(scene.cloths[0]);
  Stand stand(scene);
  const Piece& second = stand.drape.cloth.pieces()[1];
  std::vector<Particle4> apart = stand.drape.positions;
  for (std::size_t i = second.firstParticle; i < apart.size(); ++i) apart[i].y += 0.2f;
  stand.positions.upload(apart);
  const std::uint32_t particle = second.particle(24, 26);
  const glm::vec2 pixel = stand.onScreen(stand.place(particle) + glm::vec3(0, 0.2f, 0));
  const Pick pick = stand.pickAt(static_cast<double>(pixel.x), static_cast<double>(pixel.y));
  EXPECT_EQ(pick.piece, 1u);
  EXPECT_EQ(pick.particle, particle);
}

TEST_F(PickingTest, LeavesThePictureAsItWas) {
  Stand stand(test::drapeScene());
  const auto picture = [&] {
    return renderImage(stand.renderer, stand.positions.name(), stand.camera, 0, 96, 64).rgb;
  };
  const auto before = picture();
  static_cast<void>(stand.pickAt(100, 100));
  EXPECT_EQ(picture(), before);
}

}  // namespace
}  // namespace clothsim
