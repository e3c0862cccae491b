// The handles that move and turn what is chosen.
#include "viewer/gizmo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cloth/cloth.h"

namespace clothsim {
namespace {

constexpr float em = 16;
using HandleKind = GizmoHandle::Kind;

struct Seen {
  Camera camera;
  Gizmo gizmo;
  [[nodiscard]] PictureView view() const { return {camera, 1200, 800}; }
};
Seen seenFrom(double azimuth, double elevation, GizmoMode mode) {
  const Scene scene;
  Seen seen{Camera(scene, Cloth(scene)), {mode, {}}};
  seen.camera.orbit(azimuth, elevation);
  seen.gizmo.place = seen.camera.target() + glm::vec3(0.1f, 0.05f, -0.1f);
  return seen;
}

constexpr GizmoHandle moving[]{{HandleKind::arrow, 0},  {HandleKind::arrow, 1},  {HandleKind::arrow, 2},
                               {HandleKind::square, 0}, {HandleKind::square, 1}, {HandleKind::square, 2},
                               {HandleKind::center, 0}};

TEST(Gizmo, IsTakenByTheHandleUnderTheCursor) {
  int found = 0;
  for (const double azimuth : {0.0, 0.7, 2.0, 4.1})
    for (const GizmoHandle& handle : moving) {
      const Seen seen = seenFrom(azimuth, 0.3, GizmoMode::move);
      const auto grip = gripOf(handle, seen.gizmo, seen.view(), em);
      if (!grip) continue;  // it points at the eye
      const auto taken = handleAt(seen.gizmo, seen.view(), em, *grip);
      found += taken == handle;  // another one may lie before it
      EXPECT_TRUE(taken) << azimuth;
    }
  EXPECT_GE(found, 20);
  const Seen seen = seenFrom(0.7, 0.3, GizmoMode::move);
  EXPECT_FALSE(handleAt(seen.gizmo, seen.view(), em, {20, 20}));
}

// What is dragged stays under the cursor, along its axis or plane.
TEST(Gizmo, MovesAlongItsAxisOrPlaneWithTheCursor) {
  for (const double azimuth : {0.4, 2.2, 5.0})
    for (const GizmoHandle& handle : moving) {
      const Seen seen = seenFrom(azimuth, 0.35, GizmoMode::move);
      const auto grip = gripOf(handle, seen.gizmo, seen.view(), em);
      if (!grip) continue;
      GizmoDrag drag(seen.gizmo, handle, seen.view(), em, *grip);
      const glm::vec3 axis = handle.axis == 0   ? glm::vec3(1, 0, 0)
                             : handle.axis == 1 ? glm::vec3(0, 1, 0)
                                                : glm::vec3(0, 0, 1);
      const bool isArrow = handle.kind == HandleKind::arrow;
      const glm::vec3 wanted =
          isArrow ? 0.2f * axis : 0.15f * glm::cross(axis, glm::vec3(0.6f, 0.64f, 0.48f));
      if (handle.kind == HandleKind::center) continue;
      const auto from = placeInPicture(seen.view(), seen.gizmo.place),
                 to = placeInPicture(seen.view(), seen.gizmo.place + wanted);
      ASSERT_TRUE(from && to);
      GizmoDrag exact(seen.gizmo, handle, seen.view(), em, *from);
      exact.moveTo(seen.view(), *to, false);
      EXPECT_LT(length(exact.way() - toVec3d(wanted)), 1e-4);
      drag.moveTo(seen.view(), *grip, false);
      EXPECT_LT(length(drag.way()), 1e-4) << "where it was taken it has not moved";
    }
}

TEST(Gizmo, TurnsByTheRightHandRuleAndOnBeyondAHalfTurn) {
  const Seen seen = seenFrom(0.5, 0.6, GizmoMode::rotate);
  for (int axis = 0; axis < 3; ++axis) {
    const glm::vec3 w = axis == 0 ? glm::vec3(1, 0, 0) : axis == 1 ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 u(w.z, w.x, w.y), v(w.y, w.z, w.x);  // w, u, v: right-handed
    const auto at = [&](double degrees) {
      const double angle = glm::radians(degrees);
      return *placeInPicture(
          seen.view(), seen.gizmo.place + 0.2f * (float(std::cos(angle)) * u + float(std::sin(angle)) * v));
    };
    GizmoDrag drag(seen.gizmo, {HandleKind::ring, axis}, seen.view(), em, at(20));
    for (int degrees = 30; degrees <= 500; degrees += 10) drag.moveTo(seen.view(), at(degrees), false);
    EXPECT_NEAR(drag.turn(), 480, 0.05) << axis;
    drag.moveTo(seen.view(), at(488), true);
    EXPECT_EQ(drag.turn(), 465) << "in steps of 15 degrees";
    EXPECT_EQ(drag.axis(), toVec3d(w));
  }
}

// A ring that is seen as a line turns by the way along it: as far as its near side goes.
TEST(Gizmo, TurnsARingSeenFromTheEdge) {
  Seen seen = seenFrom(0, 0, GizmoMode::rotate);
  seen.camera.lookFrom(2);
  const GizmoHandle ring{HandleKind::ring, 1};
  const auto grip = gripOf(ring, seen.gizmo, seen.view(), em);
  ASSERT_TRUE(grip);
  EXPECT_EQ(handleAt(seen.gizmo, seen.view(), em, *grip), ring);
  GizmoDrag drag(seen.gizmo, ring, seen.view(), em, *grip);
  drag.moveTo(seen.view(), *grip + glm::vec2(40, 0), false);
  EXPECT_GT(drag.turn(), 20) << "about y what is before goes to the right";
  EXPECT_LT(drag.turn(), 45);
}

TEST(Gizmo, HasItsButtonsWhereTheyAreClicked) {
  EXPECT_FALSE(gizmoButtonAt(800, em, {100, 100}));
  int moves = 0, turns = 0;
  for (float x = 700; x < 800; x += 4)
    for (float y = 80; y < 160; y += 4) {
      const auto mode = gizmoButtonAt(800, em, {x, y});
      moves += mode == GizmoMode::move;
      turns += mode == GizmoMode::rotate;
    }
  EXPECT_GT(moves, 30);
  EXPECT_EQ(moves, turns);
}

}  // namespace
}  // namespace clothsim
