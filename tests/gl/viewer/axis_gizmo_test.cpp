// The axes in the corner of the picture, and the views that they lead to.
#include "viewer/axis_gizmo.h"

#include <gtest/gtest.h>

namespace clothsim {
namespace {

constexpr PictureArea gizmoArea{800, 600};
constexpr float lineHeight = 16;

Camera someCamera() {
  const Scene scene;
  return {scene, Cloth(scene)};
}

glm::vec3 directionOf(const Camera& camera) { return glm::normalize(camera.eye() - camera.target()); }

TEST(AxisGizmo, LooksFromTheEndThatIsClickedWhereverTheCameraIs) {
  for (const double azimuth : {0.0, 1.0, 2.5, 4.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool positive : {true, false}) {
        Camera camera = someCamera();
        camera.orbit(azimuth, 0.2);
        glm::vec2 place{0};
        for (const AxisEnd& end : axisEnds(camera, gizmoArea, lineHeight))
          if (end.axis == axis && end.positive == positive) place = end.place;
        const std::optional<AxisEnd> clicked = axisEndAt(camera, gizmoArea, lineHeight, place);
        ASSERT_TRUE(clicked);
        if (clicked->axis != axis || clicked->positive != positive) continue;  // a nearer one covers it
        camera.lookFrom(clicked->axis, clicked->positive);
        EXPECT_NEAR(directionOf(camera)[axis], positive ? 1 : -1, 1e-3) << "axis " << axis << ", " << azimuth;
      }
    }
  }
}

TEST(AxisGizmo, IsNotClickedElsewhere) {
  const Camera camera = someCamera();
  EXPECT_FALSE(axisEndAt(camera, gizmoArea, lineHeight, {400, 300}));
  EXPECT_FALSE(axisEndAt(camera, gizmoArea, lineHeight, {795, 5}));
}

TEST(AxisGizmo, DrawsTheNearestEndLast) {
  const auto ends = axisEnds(someCamera(), gizmoArea, lineHeight);
  for (std::size_t i = 1; i < ends.size(); ++i) EXPECT_LE(ends[i - 1].toViewer, ends[i].toViewer);
}

TEST(CameraFromAnAxis, LooksFromTheOtherSideTheSecondTimeAndKeepsTargetAndDistance) {
  for (int axis = 0; axis < 3; ++axis) {
    Camera camera = someCamera();
    const float distance = glm::distance(camera.eye(), camera.target());
    camera.lookFrom(axis);
    const glm::vec3 first = directionOf(camera);
    camera.lookFrom(axis);
    EXPECT_NEAR(directionOf(camera)[axis], -first[axis], 1e-3);
    EXPECT_NEAR(glm::distance(camera.eye(), camera.target()), distance, 1e-4 * distance);
    EXPECT_EQ(camera.target(), someCamera().target());
  }
}

}  // namespace
}  // namespace clothsim
