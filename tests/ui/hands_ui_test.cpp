// Hands on the cloth: the mouse in the real window, judged by the recording that it leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/vec.h"
#include "scene_io/scene_io.h"
#include "ui/screen.h"

namespace clothsim {
namespace {

using test::Picture;
using test::seconds;
using test::ViewerProgram;
using Json = nlohmann::json;

// The cloth hangs in the middle of the window, in every test at the same place.
const char* const heldScene = "-f pinned2 --resolution 20x20 --set solver.simulation_steps=10 --backend cpu";
constexpr int stepsInAFrame = 10;
// One that hangs at rest from the start, wherever the hands come.
const std::string hanging =
    std::string(heldScene) + " --set cloth.orientation=1 --set 'cloth.pinned=[\"top\"]'";

class HandsUi : public testing::Test {
 protected:
  // The recording of what was done up to now, saved until it shows what is waited for.
  template <class Condition>
  Json recordingWhere(const ViewerProgram& viewer, Condition&& holds) {
    Json recording;
    EXPECT_TRUE(test::eventually(seconds(30),
                                 [&] {
                                   ++saved_;
                                   file_ = "pinned2-recording" +
                                           (saved_ == 1 ? "" : "-" + std::to_string(saved_)) + ".json";
                                   viewer.press("ctrl+shift+s");
                                   if (!viewer.eventuallyHas(file_)) return false;
                                   recording = Json::parse(readFile(viewer.here() / file_));
                                   return holds(recording);
                                 }))
        << recording.dump(1).substr(0, 4000) << viewer.output();
    return recording;
  }
  static std::vector<Json> actionsIn(const Json& recording, const std::string& name) {
    std::vector<Json> found;
    for (const Json& event : recording.at("events"))
      if (event.at("action") == name) found.push_back(event);
    return found;
  }
  // What `clothsim run --json` says of repeating the recording saved last.
  Json replay(const ViewerProgram& viewer, const std::string& more) const {
    return jsonOf(viewer, "run --replay " + file_ + " --json " + more);
  }
  static Json jsonOf(const ViewerProgram& viewer, const std::string& arguments) {
    const test::CommandResult result =
        test::runCommand("cd '" + viewer.here().string() + "' && " CLOTHSIM_PROGRAM " " + arguments +
                         " 2>&1 1>out.json; cat out.json");
    Json json = Json::parse(readFile(viewer.here() / "out.json"), nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << result.output;
    return json;
  }
  static Vec3d vectorOf(const Json& numbers) { return {numbers.at(0), numbers.at(1), numbers.at(2)}; }

  test::Screen screen_{640, 480};
  int saved_ = 0;
  std::string file_;
};

// The position of a particle in a CSV file of `run --save`.
Vec3d particleIn(const std::string& csv, std::uint32_t particle) {
  std::istringstream lines(csv);
  std::string line;
  for (std::uint32_t i = 0; i < particle + 2; ++i) std::getline(lines, line);  // the header comes first
  Vec3d position;
  EXPECT_EQ(std::sscanf(line.c_str(), "%*d,%lf,%lf,%lf", &position.x, &position.y, &position.z), 3) << line;
  return position;
}

TEST_F(HandsUi, ADragOnTheClothTakesItAlongToTheCursor) {
  const ViewerProgram viewer(hanging);
  viewer.perform("at 0.5 0.5 sleep 0.3 mousedown 1 sleep 0.3 at 0.55 0.45 sleep 0.1 at 0.6 0.4");
  const Json recording = recordingWhere(viewer, [&](const Json& now) {
    const std::vector<Json> moves = actionsIn(now, "move_hand");
    // Half a second of simulated time to follow in.
    return !moves.empty() &&
           (now.at("frames").get<int>() - 45) * stepsInAFrame > moves.back().at("step").get<int>();
  });
  const std::vector<Json> grabs = actionsIn(recording, "grab");
  ASSERT_EQ(grabs.size(), 1u);
  const Vec3d start = vectorOf(grabs[0].at("target"));
  const Vec3d target = vectorOf(actionsIn(recording, "move_hand").back().at("target"));
  EXPECT_GT(std::sqrt(dot(target - start, target - start)), 0.1) << "the hand has moved with the mouse";

  // A soft spring yields to the weight that it lifts: the way that is left shrinks as its strength grows.
  const auto missedBy = [&](double stronger) {
    Json again = recording;
    for (Json& event : again.at("events"))
      if (event.at("action") == "grab") event["strength"] = stronger * event.at("strength").get<double>();
    std::ofstream(viewer.here() / "again.json") << again;
    (void)jsonOf(viewer, "run --replay again.json --json --backend cpu --save end.csv");
    const Vec3d held = particleIn(readFile(viewer.here() / "end.csv"), grabs[0].at("particle"));
    return std::sqrt(dot(held - target, held - target));
  };
  const double soft = missedBy(1), strong = missedBy(100);
  EXPECT_LT(soft, 0.12) << "the hand as it is, which must not overcome strain limit and contact";
  EXPECT_LT(strong, 0.2 * soft) << "a hundred times as strong; what is left of it is the strain limit's";

  viewer.perform("mouseup 1");
  (void)recordingWhere(viewer, [&](const Json& now) { return !actionsIn(now, "release").empty(); });
}

TEST_F(HandsUi, PinsCutsAndBlowsAreRepeatedByAReplayWithTheSameBitsOnBothBackends) {
  const ViewerProgram viewer(hanging);
  viewer.perform("keydown shift at 0.5 0.55 sleep 0.3 click 1 sleep 0.2 keyup shift");
  viewer.perform(
      "keydown x sleep 0.3 at 0.25 0.62 sleep 0.2 mousedown 1 sleep 0.2 at 0.4 0.62 sleep 0.1 at 0.5 0.63 "
      "sleep 0.1 at 0.75 0.64 sleep 0.2 mouseup 1 keyup x");
  viewer.perform("at 0.5 0.45 keydown w sleep 1 keyup w");
  const Json recording = recordingWhere(viewer, [&](const Json& now) {
    const std::vector<Json> blows = actionsIn(now, "blow");
    return blows.size() > 1 && blows.back().at("speed") == 0;
  });
  const std::vector<Json> pins = actionsIn(recording, "set_pin");
  ASSERT_EQ(pins.size(), 1u);
  EXPECT_EQ(pins[0].at("pinned"), true);
  EXPECT_GE(actionsIn(recording, "cut").size(), 2u) << "the stroke is made of several";
  EXPECT_GT(actionsIn(recording, "blow").front().at("speed"), 0);
  EXPECT_TRUE(actionsIn(recording, "grab").empty()) << "neither pins nor cuts grab";

  const Json cpu = replay(viewer, "--backend cpu"), gpu = replay(viewer, "--backend gpu");
  EXPECT_EQ(cpu.at("state_hash"), gpu.at("state_hash"));
  EXPECT_EQ(cpu.at("finite"), true);
}

TEST_F(HandsUi, APinIsMovedByTheMouseAndLetGoByAShiftClick) {
  const ViewerProgram viewer(heldScene);
  // The mark of the upper right corner: a pin does not move.
  const Picture picture = viewer.picture();
  int x = 0, y = 0;
  for (int row = 0; row < picture.height; ++row)
    for (int column = x; column < picture.width; ++column)
      if (test::isPinYellow(picture.at(column, row))) x = column, y = row;
  ASSERT_GT(x, picture.width / 2) << "no mark of a pin";
  const auto placeOf = [&](int column, int row) {
    return std::to_string((column + 0.5) / picture.width) + " " +
           std::to_string((row + 0.5) / picture.height);
  };
  viewer.perform("at " + placeOf(x, y) + " sleep 0.3 mousedown 1 sleep 0.2 at " + placeOf(x - 20, y - 10) +
                 " sleep 0.2 at " + placeOf(x - 40, y - 20) + " sleep 0.5 mouseup 1");
  const Json moved = recordingWhere(viewer, [&](const Json& now) {
    const std::vector<Json> edits = actionsIn(now, "edit_scene");
    return edits.size() > 1 &&
           now.at("frames").get<int>() * stepsInAFrame > edits.back().at("step").get<int>() + 900;
  });
  EXPECT_TRUE(actionsIn(moved, "grab").empty());
  const Json hand = actionsIn(moved, "edit_scene").back().at("scene").at("cloth").at("pin_motion").at(0);
  const Vec3d wanted = vectorOf(hand.at("keys").at(0).at("position"));
  const Json replayed = replay(viewer, "--save moved.csv");
  EXPECT_EQ(replayed.at("finite"), true);
  EXPECT_LT(length(particleIn(readFile(viewer.here() / "moved.csv"), 19) - wanted), 0.01)
      << "it has come there";
  viewer.press("ctrl+z");
  viewer.press("ctrl+z");                   // and the hand that held it
  std::this_thread::sleep_for(seconds(1));  // until it is back
  viewer.perform("keydown shift at " + placeOf(x, y) + " sleep 0.3 click 1 sleep 0.2 keyup shift");
  const Json recording =
      recordingWhere(viewer, [&](const Json& now) { return !actionsIn(now, "set_pin").empty(); });
  const std::vector<Json> pins = actionsIn(recording, "set_pin");
  ASSERT_EQ(pins.size(), 1u);
  EXPECT_EQ(pins[0].at("particle"), 19);
  EXPECT_EQ(pins[0].at("pinned"), false);
}

TEST_F(HandsUi, HandlesTurnAndMoveASolidAndUndoBringsItBack) {
  const ViewerProgram viewer(
      std::string(heldScene) +
      " --set 'colliders=[{\"type\":\"box\",\"origin\":[0.5,0.6,0.4],\"size\":[0.3,0.3,0.3]}]' --set "
      "camera.target=[0.5,0.6,0.4] --set camera.position=[0.5,0.6,3]");
  viewer.press("p");
  viewer.press("r");  // the cloth lies above the box
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused at frame 0"));
  int scenes = 0;
  const auto saved = [&] {
    const std::string file = "pinned2" + (++scenes == 1 ? "" : "-" + std::to_string(scenes)) + ".json";
    viewer.press("ctrl+s");
    EXPECT_TRUE(viewer.eventuallyHas(file)) << file;
    return std::get<Box>(loadScene(viewer.here() / file).colliders.at(0));
  };
  const Box start = saved();
  viewer.perform("at 0.5 0.5 sleep 0.3 click 1");
  const auto isArrowGreen = [](Picture::Pixel p) { return p.g > 120 && p.g > p.r + 40 && p.g > p.b + 40; };
  EXPECT_TRUE(test::eventually(seconds(20), [&] {
    return viewer.picture().share(0.48, 0.33, 0.52, 0.45, isArrowGreen) > 0.1;
  })) << "no handles";
  viewer.press("g");  // from arrows to rings
  // A quarter along the outermost ring, which faces the eye: its radius is 5.5 lines of text of 16 pixels.
  viewer.drag(1, 0.5 + 88.0 / 640, 0.5, 0.5, 0.5 - 88.0 / 480);
  const Box turned = saved();
  EXPECT_EQ(turned.origin, start.origin);
  EXPECT_NEAR(turned.rotation.z, 90, 3);
  EXPECT_NEAR(length(turned.rotation), turned.rotation.z, 1e-6);
  viewer.press("ctrl+z");
  EXPECT_EQ(saved(), start);
  viewer.press("g");
  viewer.drag(1, 0.5 + 70.0 / 640, 0.5, 0.5 + 130.0 / 640, 0.6);  // by the arrow along x
  const Box moved = saved();
  EXPECT_GT(moved.origin.x, start.origin.x + 0.05);
  EXPECT_EQ((Vec3d{start.origin.x, moved.origin.y, moved.origin.z}), start.origin);
  viewer.press("ctrl+z");
  EXPECT_EQ(saved(), start);
}

TEST_F(HandsUi, BackendsToggledInMidSwingChangeNoBit) {
  const ViewerProgram viewer(heldScene);
  viewer.press("b");
  EXPECT_TRUE(viewer.titleBecomesOneWith("- gpu -"));
  viewer.press("b");
  EXPECT_TRUE(viewer.titleBecomesOneWith("- cpu -"));
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused at frame "));
  const Json recording =
      recordingWhere(viewer, [&](const Json& now) { return actionsIn(now, "switch_backend").size() == 2; });
  const std::string frames = std::to_string(recording.at("frames").get<int>());
  EXPECT_NE(viewer.title().find("paused at frame " + frames), std::string::npos) << viewer.title();
  const Json toggled = replay(viewer, ""),
             plain = jsonOf(viewer, "run " + std::string(heldScene) + " --json --frames " + frames);
  EXPECT_EQ(toggled.at("state_hash"), plain.at("state_hash"));
}

}  // namespace
}  // namespace clothsim
