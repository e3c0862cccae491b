// The window around the cloth: every scene, every key, panels, the time line, files that it writes, shaders
// loaded anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "core/files.h"
#include "scene_io/scene_io.h"
#include "ui/screen.h"
#include "viewer/viewer_config.h"
#include "viewer/viewer_keys.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;
using test::Picture;
using test::seconds;
using test::ViewerProgram;

const char* const windowScene = "-f pinned2 --resolution 20x20 --backend cpu";

bool isAlert(Picture::Pixel p) { return p.r > 180 && p.g > 130 && p.g < 210 && p.b < 120; }

// As xdotool names it: "Ctrl+Shift+Z" -> "ctrl+shift+z", "Esc" -> "Escape".
std::string xdotoolName(std::string_view input) {
  const KeyStroke stroke = keyStroke(input);
  std::string key = stroke.key;
  if (key == "Esc") key = "Escape";
  if (key == "Space") key = "space";
  if (key == "=") key = "equal";
  if (key == "-") key = "minus";
  if (key.size() == 1) key[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(key[0])));
  return (stroke.control ? "ctrl+" : "") + std::string(stroke.shift ? "shift+" : "") + key;
}

class WindowUi : public testing::Test {
 protected:
  static void expectNoComplaints(const ViewerProgram& viewer) {
    EXPECT_EQ(viewer.output().find("OpenGL"), std::string::npos) << viewer.output();
    EXPECT_EQ(viewer.output().find("GL "), std::string::npos) << viewer.output();
  }
  test::Screen screen_{640, 480};
};

// One of each kind; pictures of all bundled scenes are drawn by the tests of their framing and of
// docs/figures.md.
TEST_F(WindowUi, OpensScenesOfEveryKindAndClosesAtOnce) {
  const std::pair<std::string, std::string> scenes[]{{"demo", "12x12"},   // a grid
                                                     {"stack", "12x12"},  // of several cloths
                                                     {"tear", "12x12"},   // cut
                                                     {"skirt", ""},       // a mesh
                                                     {"pillow", ""},      // with seams and air inside
                                                     {"walk", ""}};       // on a figure that moves
  for (const auto& [scene, resolution] : scenes) {
    SCOPED_TRACE(scene);
    // The title has the backend once there was a picture.
    ViewerProgram viewer(
        "-f " + scene + (resolution.empty() ? "" : " --resolution " + resolution) + " --backend cpu", "",
        scene + " - cpu");
    EXPECT_EQ(viewer.title().find(scene + " - cpu"), 0u) << viewer.title();
    viewer.press("Escape");
    EXPECT_EQ(viewer.exitCodeWithin(seconds(10)), 0) << viewer.output();
    expectNoComplaints(viewer);
  }
}

TEST_F(WindowUi, ClosesAtOnceWithinAFrameThatWouldTakeMinutes) {
  ViewerProgram viewer("-f pinned2 --backend cpu --set solver.simulation_steps=1000000", "", "pinned2 - cpu");
  viewer.press("Escape");
  EXPECT_EQ(viewer.exitCodeWithin(seconds(10)), 0) << viewer.output();
}

TEST_F(WindowUi, AnswersWithinAFrameThatWouldTakeMinutes) {
  ViewerProgram viewer("-f pinned2 --backend cpu --set solver.simulation_steps=1000000", "", "pinned2 - cpu");
  const Picture before = viewer.stillPicture();
  viewer.press("F2");
  EXPECT_TRUE(test::eventually(seconds(3), [&] { return viewer.picture() != before; }))
      << "the overlay stays";
  const Picture bare = viewer.stillPicture();
  viewer.drag(1, 0.5, 0.75, 0.7, 0.8);
  EXPECT_TRUE(test::eventually(seconds(3), [&] { return viewer.picture() != bare; })) << "the camera rests";
  viewer.press("p");
  EXPECT_TRUE(viewer.titleBecomesOneWith("paused at frame 0")) << viewer.title();
  viewer.press("b");  // waits for the frame
  viewer.press("Escape");
  EXPECT_EQ(viewer.exitCodeWithin(seconds(2)), 0) << viewer.output();
}

TEST_F(WindowUi, SaysWhatItLoadsAndClosesAtOnceMeanwhile) {
  ViewerProgram viewer("-f pinned2 --backend cpu --resolution 2048x2048", "", "pinned2 - loading");
  viewer.press(
      "Escape");  // some seconds before it is loaded; on a busy machine giving back its memory takes one
  EXPECT_EQ(viewer.exitCodeWithin(seconds(3)), 0) << viewer.output();
}

TEST_F(WindowUi, GoesOnWithAMessageWhenAFileCannotBeNamed) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / (std::string(245, 'x') + ".json");
  saveScene(loadSceneByName("pinned2"), scene);
  const ViewerProgram viewer("-f " + scene.string() + " --resolution 12x12 --backend cpu");
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused"));
  const auto isShown = [&] { return viewer.picture().share(0, 0.7, 1, 1, isAlert) > 0.002; };
  EXPECT_FALSE(isShown());
  for (const char* key : {"ctrl+p", "ctrl+r", "ctrl+shift+s"}) viewer.press(key);
  EXPECT_TRUE(test::eventually(seconds(20), isShown)) << "no message";
  viewer.press("p");
  EXPECT_TRUE(viewer.titleBecomesOneWith("fps")) << viewer.output();
}

TEST_F(WindowUi, GoesOnWithTheCpuAndItsEditsWhenTheDeviceIsReset) {
  const test::TemporaryFolder folder;
  const std::string sign = (folder / "lost").string();
  const ViewerProgram viewer(
      "-f pinned2 --resolution 12x12 --backend gpu",
      "ASAN_OPTIONS=verify_asan_link_order=0 LOSE_CONTEXT_WHEN='" + sign + "' LD_PRELOAD='" LOST_CONTEXT "'",
      "pinned2 - gpu");
  viewer.press("i");
  ASSERT_TRUE(test::eventually(seconds(20), [&] {
    viewer.press("ctrl+s");
    return viewer.eventuallyHas("pinned2.json");
  }));
  std::ofstream(sign) << "now";
  ASSERT_TRUE(viewer.titleBecomesOneWith("pinned2 - cpu")) << viewer.output();
  EXPECT_TRUE(test::eventually(seconds(20), [&] {
    return viewer.picture().share(0, 0.5, 1, 1, isAlert) > 0.002;
  })) << "no message";
  viewer.press("ctrl+s");
  ASSERT_TRUE(viewer.eventuallyHas("pinned2-2.json"));
  EXPECT_EQ(loadScene(viewer.here() / "pinned2-2.json"), loadScene(viewer.here() / "pinned2.json"));
  EXPECT_EQ(loadScene(viewer.here() / "pinned2-2.json").solver.integrator, Integrator::euler);
  viewer.press("ctrl+shift+s");
  ASSERT_TRUE(viewer.eventuallyHas("pinned2-recording.json"));
  EXPECT_NE(readFile(viewer.here() / "pinned2-recording.json").find("cpu"), std::string::npos)
      << "it holds the change of the backend";
}

TEST_F(WindowUi, EscClosesTheCardOfTheComparisonFirst) {
  const ViewerProgram viewer(windowScene);
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused"));
  const Picture before = viewer.stillPicture();
  viewer.press("c");
  ASSERT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() != before; }));
  viewer.press("Escape");
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() == before; }))
      << "the card is gone, and the window is not";
}

TEST_F(WindowUi, TakesEveryKeyOfItsListAndGoesOn) {
  ViewerProgram viewer(windowScene);
  for (const ViewerKey& key : viewerKeys) {
    if (key.action == ViewerAction::none || key.action == ViewerAction::quit) continue;
    viewer.press(xdotoolName(key.input));
    if (key.action == ViewerAction::openFile) viewer.press("Escape");  // its dialog takes the keys
    if (key.action == ViewerAction::reloadScene) {
      ASSERT_TRUE(viewer.titleBecomesOneWith("fps")) << viewer.title();
    }
    ASSERT_FALSE(viewer.exitCodeWithin(test::milliseconds(50))) << key.input << ": " << viewer.output();
  }
  EXPECT_TRUE(test::eventually(seconds(20), [&] {
    const auto count = std::distance(fs::directory_iterator(viewer.here()), fs::directory_iterator());
    return count >= 3;  // screenshot, scene, recording; the clip's file comes with its end
  })) << viewer.output();
  for (int i = 0; i < 4 && !viewer.exitCodeWithin(seconds(2)); ++i) viewer.press("Escape");
  EXPECT_EQ(viewer.exitCodeWithin(seconds(10)), 0) << "what is open closes first: " << viewer.output();
  expectNoComplaints(viewer);
}

TEST_F(WindowUi, WritesScreenshotsAndClipsUnderNamesThatNothingHas) {
  const ViewerProgram viewer(windowScene);
  viewer.press("ctrl+r");
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused at frame "));
  std::this_thread::sleep_for(seconds(1));  // a frame that was under way ends after the pause
  std::string frame = viewer.title().substr(viewer.title().find("frame ") + 6);
  frame.erase(frame.find(' '));
  viewer.press("ctrl+p");
  EXPECT_TRUE(viewer.eventuallyHas("pinned2-cpu-" + frame + ".png"));
  viewer.press("ctrl+p");
  EXPECT_TRUE(viewer.eventuallyHas("pinned2-cpu-" + frame + "-2.png"));
  viewer.press("ctrl+r");
  EXPECT_TRUE(test::eventually(seconds(20), [&] {
    return fs::exists(viewer.here() / "pinned2-cpu.mp4") || fs::exists(viewer.here() / "pinned2-cpu-frames");
  }));
  const fs::path film = viewer.here() / "pinned2-cpu.mp4";
  if (fs::exists(film)) {
    EXPECT_GT(fs::file_size(film), 1000u);
  }
}

TEST_F(WindowUi, SavesASceneThatLoadsAgain) {
  const ViewerProgram viewer(std::string(windowScene) + " --set cloth.damping=0.7");
  viewer.press("ctrl+s");
  ASSERT_TRUE(viewer.eventuallyHas("pinned2.json"));
  EXPECT_EQ(loadScene(viewer.here() / "pinned2.json").cloths[0].damping, 0.7);
}

TEST_F(WindowUi, LooksBackOverKeptFramesAndGoesOnFromThere) {
  const ViewerProgram viewer(windowScene);
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused at frame "));
  viewer.press("r");
  viewer.press("F2");
  const Picture start = viewer.stillPicture();
  const auto frame = [&] {
    const std::string title = viewer.title();
    return std::atoi(title.c_str() + title.find("frame ") + 6);
  };
  const auto becomes = [&](int wanted) {
    return test::eventually(seconds(20), [&] { return frame() == wanted; });
  };
  const int first = 0;
  ASSERT_TRUE(becomes(first)) << "frames are counted from the restart: " << viewer.title();
  for (int i = 1; i <= 3; ++i) {
    viewer.press("n");
    ASSERT_TRUE(becomes(first + i)) << viewer.title();
  }
  for (int i = 2; i >= 0; --i) {
    viewer.press("Left");
    ASSERT_TRUE(becomes(first + i)) << viewer.title();
  }
  viewer.press("Right");
  EXPECT_TRUE(becomes(first + 1)) << viewer.title();
  viewer.press("n");
  EXPECT_TRUE(becomes(first + 2)) << "one frame on, from the past: " << viewer.title();
  viewer.press("p");
  EXPECT_TRUE(viewer.titleBecomesOneWith("fps")) << viewer.title();
}

TEST_F(WindowUi, IChangesTheIntegratorThatTheOverlayNamesAndUndoAndRedoDo) {
  const ViewerProgram viewer(windowScene);
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused at frame "));
  const auto settled = [&] {
    std::this_thread::sleep_for(seconds(3));  // the notice is gone by then
    return viewer.stillPicture();
  };
  const Picture verlet = viewer.stillPicture();
  viewer.press("i");
  const Picture euler = settled();
  EXPECT_NE(euler, verlet) << "the panel of facts names the other integrator";
  viewer.press("ctrl+z");
  EXPECT_EQ(settled(), verlet);
  viewer.press("ctrl+shift+z");
  EXPECT_EQ(settled(), euler);
  for (int i = 0; i < 3; ++i) viewer.press("i");  // after the implicit ones comes the first again
  EXPECT_EQ(settled(), verlet);
}

TEST_F(WindowUi, ShowsWhatIsWrongWithAShaderAndGoesOnWithTheOldOne) {
  const test::TemporaryFolder root;
  for (const char* part : {"shaders", "assets"})
    fs::copy(fs::path(SOURCE_ROOT) / part, root / part, fs::copy_options::recursive);
  const ViewerProgram viewer(windowScene, "CLOTHSIM_ROOT='" + root.path().string() + "'");
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused"));
  const fs::path shader = root / "shaders" / "render" / "tone.glsl";
  const std::string sound = readFile(shader);
  const auto isShown = [&] { return viewer.picture().share(0, 0.5, 1, 1, isAlert) > 0.002; };
  EXPECT_FALSE(isShown());
  std::ofstream(shader) << sound << "\nthis is no GLSL\n";
  viewer.press("F5");
  EXPECT_TRUE(test::eventually(seconds(20), isShown)) << "no message";
  std::ofstream(shader) << sound;
  viewer.press("F5");
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return !isShown(); })) << "the message stays";
}

// By the keyboard alone, then by the mouse.
TEST_F(WindowUi, OpensASceneFromAFolderNamesWhatIsWrongWithAnotherAndRemembersTheFolder) {
  ViewerProgram viewer(windowScene);
  fs::create_directories(viewer.here() / "scenes" / "old");
  fs::copy(fs::path(SOURCE_ROOT) / "assets" / "scenes" / "plane.json",
           viewer.here() / "scenes" / "mine.json");
  std::ofstream(viewer.here() / "scenes" / "wrong.json") << R"({"cloth": {"width": "wide"}})";
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused"));
  const auto type = [&](const std::string& words) { viewer.perform("sleep 0.5 type --delay 100 " + words); };
  const auto shown = [&](auto&& condition) { return test::eventually(seconds(20), condition); };
  const auto hasFault = [&] { return viewer.picture().share(0, 0.7, 1, 0.9, isAlert) > 0.002; };
  viewer.press("ctrl+o");
  type("scenes/");
  viewer.press("Return");
  type("wrong");
  EXPECT_TRUE(shown(hasFault)) << "the chosen file's fault is not named";
  viewer.press("Return");
  viewer.perform("sleep 1 key --delay 100 BackSpace BackSpace BackSpace BackSpace BackSpace");
  EXPECT_TRUE(shown([&] { return !hasFault(); }));
  EXPECT_EQ(viewer.title().find("pinned2"), 0u) << viewer.title();
  viewer.perform("key Down key Down key Up");  // old, mine, wrong
  viewer.press("Return");
  ASSERT_TRUE(viewer.titleBecomesOneWith("mine - cpu")) << viewer.title();
  EXPECT_NE(viewer.settings().find("/here/scenes\""), std::string::npos) << viewer.settings();
  viewer.press("ctrl+o");
  EXPECT_TRUE(shown([&] {  // into "old"
    viewer.perform("sleep 0.5 at 0.2 0.3 sleep 0.3 click --repeat 2 --delay 80 1 sleep 0.5");
    return viewer.settings().find("/here/scenes/old\"") != std::string::npos;
  })) << viewer.settings();
  viewer.perform("key Escape sleep 0.7 key p");  // keys of one frame are the dialog's still
  EXPECT_TRUE(viewer.titleBecomesOneWith("paused")) << "keys are the viewer's again: " << viewer.title();
}

class PanelsUi : public testing::Test {
 protected:
  // The tabs stand at the right in two rows of three.
  static void click(const ViewerProgram& viewer, std::size_t panel) {
    const double x = 0.780 + 0.085 * static_cast<double>(panel % 3), y = panel < 3 ? 0.035 : 0.085;
    viewer.perform("at " + std::to_string(x) + " " + std::to_string(y) + " sleep 0.3 click 1");
  }
  static bool settingsSay(const ViewerProgram& viewer, const std::string& words) {
    return test::eventually(seconds(20), [&] { return viewer.settings().find(words) != std::string::npos; });
  }
  test::Screen screen_{1024, 600};
};

TEST_F(PanelsUi, SaveTheClothAsItIsByTheNamesEnding) {
  const ViewerProgram viewer(windowScene);
  // The line under "Reset to what was loaded", and its button. On a busy machine part of what is typed may be
  // lost.
  const std::string press = " sleep 0.3 mousedown 1 sleep 0.3 mouseup 1 sleep 0.3";
  fs::path mesh;
  EXPECT_TRUE(test::eventually(seconds(40), [&] {
    viewer.perform("at 0.85 0.305" + press + " type --delay 100 cloth.obj");
    viewer.perform("at 0.957 0.305" + press);
    for (const fs::path& path : fs::directory_iterator(viewer.here()))
      if (path.extension() == ".obj") mesh = path;
    return !mesh.empty();
  }));
  EXPECT_TRUE(readFile(mesh).starts_with("# clothsim, step ")) << mesh;
}

// Double clicks type; what is typed counts when Enter ends it.
TEST_F(PanelsUi, TakeTypedNumbersKeepPinsInPlaceAndCloseAListAtEsc) {
  ViewerProgram viewer("-f pinned2 --resolution 12x12");
  click(viewer, 1);
  ASSERT_TRUE(settingsSay(viewer, "\"panel\": \"" + std::string(panelNames[1]) + "\""));
  viewer.press("p");  // a scene that rests leaves the processor to other tests
  const auto type = [&](int y, const std::string& number) {  // into the slider at that height [pixels]
    viewer.perform("at 0.915 " + std::to_string(y / 600.0) +
                   " sleep 0.3 click --repeat 2 --delay 80 1 sleep 0.7 type --delay 100 " + number);
    viewer.perform("sleep 0.5 key Return sleep 0.7");
  };
  const auto saved = [&] {
    fs::remove(viewer.here() / "pinned2.json");
    viewer.press("ctrl+s");
    EXPECT_TRUE(viewer.eventuallyHas("pinned2.json"));
    return loadScene(viewer.here() / "pinned2.json").cloths[0];
  };
  EXPECT_TRUE(test::eventually(seconds(60), [&] {
    type(192, "1,5");
    return saved().density == 1.5;
  })) << saved().density;
  type(192, "2lb");
  EXPECT_EQ(saved().density, 1.5) << "nor a number of another unit";
  EXPECT_TRUE(test::eventually(seconds(60), [&] {
    type(192, "150g/m^2");
    return saved().density == 0.15;
  })) << saved().density;
  EXPECT_TRUE(test::eventually(seconds(60), [&] {
    type(348, "23");
    return saved().numWidthPoints == 23;
  })) << saved().numWidthPoints;
  EXPECT_EQ(saved().pinned, (std::vector<Pin>{GridPoint{0, 0}, GridPoint{22, 0}}));

  viewer.perform("at 0.915 0.2 sleep 0.3 click 1 sleep 1 key Escape");
  EXPECT_EQ(viewer.exitCodeWithin(seconds(2)), std::nullopt) << "Esc closes the list of materials";
  viewer.perform("key p key ctrl+r sleep 1.5 key Escape");
  EXPECT_EQ(viewer.exitCodeWithin(seconds(20)), 0) << viewer.output();
  EXPECT_TRUE(fs::exists(viewer.here() / "pinned2-cpu.mp4") ||
              fs::exists(viewer.here() / "pinned2-cpu-frames"))
      << "a clip is kept: " << viewer.output();
}

TEST_F(PanelsUi, ChangeAtAClickOpenScenesByTheirPicturesAndAreRememberedInTheUsersFolder) {
  ViewerProgram viewer(windowScene);
  for (const std::size_t panel : {1u, 2u, 3u, 4u, 5u, 0u}) {
    click(viewer, panel);
    EXPECT_TRUE(settingsSay(viewer, "\"panel\": \"" + std::string(panelNames[panel]) + "\""))
        << viewer.settings();
  }
  const std::string fourth = bundledScenes().at(3).name;  // by name, two pictures a row
  EXPECT_TRUE(test::eventually(seconds(40), [&] {
    viewer.perform("at 0.922 0.633 sleep 0.3 click 1 sleep 1");
    return viewer.title().find(fourth + " - cpu") == 0;
  })) << viewer.title();
  viewer.press("ctrl+equal");
  EXPECT_TRUE(settingsSay(viewer, "\"text_size\": 1.125")) << viewer.settings();
  viewer.press("ctrl+minus");
  EXPECT_TRUE(settingsSay(viewer, "\"text_size\": 1.0")) << viewer.settings();
  viewer.press("F3");
  EXPECT_TRUE(settingsSay(viewer, "\"show_panels\": false")) << viewer.settings();
  EXPECT_TRUE(viewer.leftNoFiles()) << "imgui.ini, perhaps";
  viewer.press("Escape");
  EXPECT_EQ(viewer.exitCodeWithin(seconds(10)), 0) << viewer.output();
}

}  // namespace
}  // namespace clothsim
