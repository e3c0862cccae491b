// Boxes that tell what is far from a collider.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "scene/colliders/collider_set.h"
#include "solver/cpu/collider_frames.h"
#include "solver/cpu/shapes.h"
#include "support/lone_particle.h"

namespace clothsim {
namespace {

// By the law that passes have.
double distanceFrom(const ColliderSet& colliders, const shared::ColliderParams<double>& params, Vec3d p) {
  const Vec3d own = cpu::toOwnFrame(params, p);
  return params.type == COLLIDER_SPHERE
             ? length(own) - params.radius
             : cpu::nearestOnShape(params, own, colliders.distances()->data()).distance;
}

class ColliderBoxes : public testing::TestWithParam<Collider> {};

// What the box says is true, and it says so of most of what is far: a particle that moves 5 cm at most, about
// a shape at rest, or one that goes and turns.
TEST_P(ColliderBoxes, AreFarFromWhatIsFarOnly) {
  for (const bool moves : {false, true}) {
    Collider collider = GetParam();
    if (moves)
      std::visit(
          [](auto& shape) {
            shape.motion = Motion{{{0, {}, {}}, {1, {0.2, 0.1, 0}, {0, 90, 30}}}};
          },
          collider);
    const ColliderSet colliders(test::particleScene(collider, 0.01));
    const auto params = colliders.params<float>(0, 0.49, 0.5);
    ASSERT_EQ(params.moving != 0, moves);
    const auto exact = colliders.params<double>(0, 0.49, 0.5);
    const cpu::ColliderBox<float> box(params);
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> place(-1.5, 1.5), way(-0.03, 0.03);
    int far = 0, told = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3d start{place(engine), place(engine), place(engine)},
          moved{way(engine), way(engine), way(engine)}, end = start + moved;
      const float margin = i % 2 == 0 ? 0 : 0.04f;
      const double distance = distanceFrom(colliders, exact, end),
                   free = std::max(length(moved) + (moves ? 0.02 : 0), static_cast<double>(margin));
      const bool isTold = box.isFarFrom(params, moves, start.cast<float>(), end.cast<float>(), margin);
      const double least = std::max(static_cast<double>(margin), length(end - cpu::carried(exact, start)));
      EXPECT_TRUE(!isTold || distance > least)
          << i << (moves ? " moves: " : " rests: ") << distance << " m from it";
      far += distance > 2 * free + 0.1 ? 1 : 0;
      told += isTold ? 1 : 0;
    }
    EXPECT_GT(far, 1000);
    EXPECT_GT(told, 0.8 * far);
    EXPECT_LT(told, 3000);
  }
}
INSTANTIATE_TEST_SUITE_P(
    Shapes, ColliderBoxes,
    testing::Values(Collider(Sphere{.radius = 0.3}), Collider(Capsule{.length = 0.5, .radius = 0.1}),
                    Collider(Box{.size = {0.6, 0.4, 0.5}, .rounding = 0.05}),
                    Collider(Torus{.radius = 0.3, .tubeRadius = 0.1}),
                    Collider(MeshCollider{.file = "assets/meshes/pawn.obj", .cells = 16}),
                    Collider(Cylinder{.height = 0.5, .radius = 0.3}),
                    Collider(Cone{.height = 0.5, .radius = 0.1, .topRadius = 0.4})),
    [](const auto& instance) {
      return std::visit([](const auto& shape) { return std::string(shape.type); }, instance.param);
    });

// Neither a plane nor a body that deforms has a box.
TEST(ColliderBoxes, AreNotAroundWhatHasNoEndOrDeforms) {
  const MeshCollider walk{.file = "assets/meshes/walk/walk_%02d.obj", .cells = 16, .shapes = 2};
  for (const Collider& collider : {Collider(Plane{}), Collider(walk)}) {
    const ColliderSet colliders(test::particleScene(collider, 0.01));
    const auto params = colliders.params<float>(0, 0, 0.01);
    const cpu::ColliderBox<float> box(params);
    EXPECT_FALSE(box.isFarFrom(params, params.moving != 0, {0, 50, 0}, {0, 50, 0}, 0)) << typeOf(collider);
  }
}

// Not a number is never far, so that the passes see it.
TEST(ColliderBoxes, DoNotHideWhatIsNoNumber) {
  const ColliderSet colliders(test::particleScene(Sphere{.radius = 0.3}, 0.01));
  const auto params = colliders.params<float>(0, 0, 0);
  const cpu::ColliderBox<float> box(params);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(box.isFarFrom(params, false, {0, 2, 0}, {0, 2, 0}, 0));
  EXPECT_FALSE(box.isFarFrom(params, false, {0, 2, 0}, {nan, 2, 0}, 0));
  EXPECT_FALSE(box.isFarFrom(params, false, {0, nan, 0}, {0, 2, 0}, 0));
}

}  // namespace
}  // namespace clothsim
