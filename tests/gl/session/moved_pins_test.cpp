// Pins that hands move: by edits of the scene, at a hand's pace.
#include "session/moved_pins.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene_io/scene_io.h"
#include "session/carry_over.h"
#include "session/session.h"
#include "solver/pin_paths.h"
#include "solver/state.h"

namespace clothsim {
namespace {

constexpr int GRID_COLUMNS = 12;

class MovedPins : public testing::Test {
 protected:
  static Scene hangingSheet() {
    Scene scene = loadSceneByName("pinned2");
    (void)changeResolution(scene, GRID_COLUMNS, GRID_COLUMNS, true);
    scene.solver.simulationSteps = 10;
    return scene;
  }
  [[nodiscard]] Vec3d positionOf(std::uint32_t particle) {
    const Particle4 p = session_.simulation().solver().positions(particle, 1)[0];
    return {p.x, p.y, p.z};
  }
  [[nodiscard]] const Scene& scene() const { return session_.simulation().scene(); }
  [[nodiscard]] const Cloth& cloth() const { return session_.simulation().cloth(); }
  [[nodiscard]] PinGroup groupOf(std::uint32_t particle) const {
    return pinGroupOf(scene(), cloth(), particle).value_or(PinGroup{});
  }
  void hold(const PinGroup& group) {
    session_.act(EditScene{withPinsHeld(scene(), group, cloth(), [&](auto i) { return positionOf(i); })});
  }
  void move(const PinGroup& group, Vec3d pivot, const Matrix3& turn, Vec3d way) {
    session_.act(EditScene{withPinsMoved(scene(), group, cloth(), pivot, turn, way)});
  }
  void step(int frames) { ASSERT_EQ(session_.stepFrames(frames), std::nullopt); }

  Session session_{hangingSheet(), "cpu", makeCpuSolver};
  // pinned2 holds both ends of its first row.
  static constexpr std::uint32_t first = 0, last = GRID_COLUMNS - 1;
};

TEST_F(MovedPins, ChangeNoBitWhileHandsHoldThemWhereTheyAre) {
  Session plain(hangingSheet(), "cpu", makeCpuSolver);
  hold(groupOf(first));
  hold(groupOf(last));
  ASSERT_EQ(plain.stepFrames(20), std::nullopt);
  step(20);
  EXPECT_EQ(stateHash(session_.simulation().solver().state()),
            stateHash(plain.simulation().solver().state()));
  EXPECT_EQ(parseScene(formatScene(scene()), "saved"), scene()) << "the scene says it all";
}

TEST_F(MovedPins, AreSavedWhereAHandSetThemAndNotWhereItTookThemOff) {
  Scene twoSheets = hangingSheet();
  twoSheets.cloths.push_back(twoSheets.cloths[0]);
  twoSheets.cloths[1].pinned = {GridSide::top};
  Session session(twoSheets, "cpu", makeCpuSolver);
  const auto saved = [&] {
    const Simulation& simulation = session.simulation();
    return withPinsByHand(simulation.scene(), simulation.cloth(), session.simulation().solver().state());
  };
  EXPECT_EQ(saved(), twoSheets);
  const std::uint32_t inTheMiddle = 5 * GRID_COLUMNS + 3, other = GRID_COLUMNS * GRID_COLUMNS;
  session.act(SetPin{inTheMiddle, true});
  session.act(SetPin{other + 1, false});
  ASSERT_EQ(session.stepFrames(2), std::nullopt);
  const Scene scene = saved();
  std::vector<Pin> pins = twoSheets.cloths[0].pinned;
  pins.emplace_back(GridPoint{3, 5});
  EXPECT_EQ(scene.cloths[0].pinned, pins);
  const Cloth before(twoSheets), after(scene);
  for (std::uint32_t i = 0; i < before.particleCount(); ++i) {
    const bool isPinned = i == inTheMiddle || (i != other + 1 && before.inverseMasses()[i] == 0);
    EXPECT_EQ(after.inverseMasses()[i] == 0, isPinned) << i;
  }
}

TEST_F(MovedPins, GoAtAHandsPaceAndComeBackWhenThatIsUndone) {
  step(5);
  const PinGroup group = groupOf(last);
  ASSERT_EQ(group.pins.size(), 1u);
  hold(group);
  const Vec3d from = positionOf(last), other = positionOf(first), way{0.1, 0.6, -0.2};
  move(group, from, identityMatrix, way);
  const double longest = HAND_SPEED / scene().solver.framesPerSec;
  for (int frame = 0; frame < 120; ++frame) {
    const Vec3d before = positionOf(last);
    step(1);
    ASSERT_LE(length(positionOf(last) - before), 1.001 * longest) << frame;
  }
  EXPECT_LT(length(positionOf(last) - (from + way)), 1e-3);
  EXPECT_LT(length(placesOf(group, scene(), cloth())[0] - (from + way)), 1e-6);
  EXPECT_EQ(positionOf(first), other) << "the other pin stays";
  session_.undo();
  session_.undo();  // and the hand, which holds on: else the pin would stay on its way
  step(120);
  EXPECT_LT(length(positionOf(last) - from), 1e-3);
}

TEST_F(MovedPins, TurnTogetherAboutTheirMiddle) {
  const PinGroup both = wholePinGroup(scene(), 0);
  ASSERT_EQ(both.pins.size(), 2u);
  hold(both);
  const Vec3d a = positionOf(first), b = positionOf(last), middle = 0.5 * (a + b);
  const Matrix3 turn = rotationMatrix({0, 90, 0});
  move(both, middle, turn, {0, 0.1, 0});
  step(150);
  EXPECT_LT(length(positionOf(first) - (middle + rotate(turn, a - middle) + Vec3d{0, 0.1, 0})), 1e-3);
  EXPECT_LT(length(positionOf(last) - (middle + rotate(turn, b - middle) + Vec3d{0, 0.1, 0})), 1e-3);
}

TEST_F(MovedPins, MayBeOnesThatTheUserHasSetWhereverTheClothWas) {
  constexpr std::uint32_t inside = 6 * GRID_COLUMNS + 5;
  step(30);
  session_.act(SetPin{inside, true});
  const Vec3d from = positionOf(inside);
  const PinGroup group = groupOf(inside);
  ASSERT_EQ(group.pins, (std::vector<Pin>{GridPoint{5, 6}}));
  hold(group);
  step(3);
  EXPECT_LT(length(positionOf(inside) - from), 1e-6) << "it is held where it was pinned";
  move(group, from, identityMatrix, {0, 0.2, 0.1});
  step(120);
  EXPECT_LT(length(positionOf(inside) - (from + Vec3d{0, 0.2, 0.1})), 1e-3);
}

TEST_F(MovedPins, AreNotThoseThatAPathOfTheSceneMoves) {
  const Scene twist = loadSceneByName("twist");
  const Cloth moved(twist);
  const auto pinned = std::ranges::find(moved.inverseMasses(), 0.0);
  ASSERT_NE(pinned, moved.inverseMasses().end());
  EXPECT_FALSE(pinGroupOf(twist, moved, static_cast<std::uint32_t>(pinned - moved.inverseMasses().begin())));
  EXPECT_TRUE(wholePinGroup(twist, 0).pins.empty());
}

}  // namespace
}  // namespace clothsim
