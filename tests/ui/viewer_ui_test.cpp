// The real window, with real keys, looked at as a person would.
#include <gtest/gtest.h>

#include "ui/screen.h"

namespace clothsim {
namespace {

using test::Picture;
using test::seconds;
using test::ViewerProgram;

// A small cloth in a small window: llvmpipe draws it on a busy machine, too.
const char* const shownScene = "-f pinned2 --resolution 24x24";

bool isClothRed(Picture::Pixel p) { return p.r > 60 && p.r > 2 * p.g && p.r > 2 * p.b; }
bool isDark(Picture::Pixel p) { return p.r < 60 && p.g < 60 && p.b < 60; }

class ViewerUi : public testing::Test {
 protected:
  test::Screen screen_{640, 480};
};

TEST_F(ViewerUi, ShowsTheClothInItsColourAndThePanelOfFacts) {
  const ViewerProgram viewer(shownScene);
  // At the start it is seen edge-on.
  EXPECT_TRUE(
      test::eventually(seconds(20), [&] { return viewer.picture().share(0, 0, 1, 1, isClothRed) > 0.03; }));
  const Picture picture = viewer.picture();
  EXPECT_LT(picture.share(0.9, 0, 1, 1, isClothRed), 0.5) << "the cloth is framed with room around it";
  EXPECT_GT(picture.share(0, 0, 1, 1, test::isPinYellow), 0) << "and its pins are marked";
}

TEST_F(ViewerUi, NamesSceneAndBackendInTheTitleAndBChangesTheBackend) {
  const ViewerProgram viewer(shownScene);
  EXPECT_NE(viewer.title().find("pinned2 - cpu - "), std::string::npos)
      << viewer.title() << ": OpenGL is a software renderer under Xvfb";
  EXPECT_NE(viewer.output().find("simulating on the CPU, since"), std::string::npos) << viewer.output();
  viewer.press("b");
  EXPECT_TRUE(viewer.titleBecomesOneWith("- gpu -")) << viewer.title();
  viewer.press("b");
  EXPECT_TRUE(viewer.titleBecomesOneWith("- cpu -")) << viewer.title();
}

TEST_F(ViewerUi, ChangesTheBackendWithoutMovingTheCloth) {
  const ViewerProgram viewer(std::string(shownScene) + " --backend gpu");
  viewer.press("F2");
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused")) << viewer.title();
  const Picture onGpu = viewer.stillPicture();
  viewer.press("b");
  ASSERT_TRUE(viewer.titleBecomesOneWith("- cpu -"));
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() == onGpu; }))
      << "the notice goes, the picture stays";
}

// A quarter of the other windows: each of the 64 exposures is a whole picture.
TEST(ViewerUiInASmallWindow, RefinesWhatRestsInFinalQualityToTheSamePictureEachTime) {
  const test::Screen screen(320, 240);
  const ViewerProgram viewer("-f pinned2 --resolution 9x9 --quality final");
  viewer.press("F2");
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused")) << viewer.title();
  const Picture refined = viewer.stillPicture(seconds(2), seconds(100));  // an exposure takes a while
  viewer.press("F1");                                                     // the list of keys: it begins anew
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() != refined; }));
  viewer.press("F1");
  EXPECT_TRUE(test::eventually(seconds(100), [&] { return viewer.picture() == refined; }));
}

TEST_F(ViewerUi, PStopsThePictureNMovesItOnByAFrameAndSSlowsItDown) {
  const ViewerProgram viewer(shownScene);
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused")) << viewer.title();
  const Picture before = viewer.stillPicture();
  viewer.press("n");
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() != before; }))
      << "N changes nothing";
  const Picture after = viewer.stillPicture();
  EXPECT_NE(after, before);
  const auto frame = [&] {
    const std::string title = viewer.title();
    return std::atoi(title.c_str() + title.find("frame ") + 6);
  };
  const int first = frame();
  for (int i = 0; i < 3; ++i) viewer.press("s");  // a tenth of real time
  const auto start = std::chrono::steady_clock::now();
  viewer.press("p");
  EXPECT_TRUE(viewer.titleBecomesOneWith("fps")) << viewer.title();
  std::this_thread::sleep_for(seconds(2));
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused")) << viewer.title();
  const std::chrono::duration<double> past = std::chrono::steady_clock::now() - start;
  EXPECT_GT(frame(), first);
  EXPECT_LT(frame() - first, 2 + 0.1 * 90 * past.count()) << "pinned2 has 90 frames a second";
}

TEST_F(ViewerUi, RRestartsFromTheSameBeginning) {
  const ViewerProgram viewer(shownScene);
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused"));
  const Picture underWay = viewer.stillPicture();
  viewer.press("r");
  ASSERT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() != underWay; }));
  const Picture beginning = viewer.stillPicture();
  const auto isBeginning = [&](const Picture& picture) { return picture.upper(0.9) == beginning.upper(0.9); };
  viewer.press("n");
  ASSERT_TRUE(test::eventually(seconds(20), [&] { return !isBeginning(viewer.picture()); }));
  viewer.press("r");
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return isBeginning(viewer.picture()); }));
}

TEST_F(ViewerUi, StartsAgainAfterTheTimeThatIsAskedFor) {
  // It would be too fast after three quarters of a second.
  const ViewerProgram viewer(
      std::string(shownScene) +
      " --set gravity=[0,-2,0] --set cloth.damping=0 --set solver.max_speed=1.5 --restart 0.4");
  ASSERT_TRUE(viewer.titleBecomesOneWith("fps")) << viewer.title();
  EXPECT_FALSE(
      test::eventually(seconds(3), [&] { return viewer.title().find("paused") != std::string::npos; }));
  const Picture now = viewer.picture();
  EXPECT_TRUE(test::eventually(seconds(5), [&] { return viewer.picture() != now; })) << "it stands still";
}

TEST_F(ViewerUi, MouseMovesTheCameraAndSpaceBringsItBack) {
  const ViewerProgram viewer(shownScene);
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused"));
  const Picture home = viewer.stillPicture();
  const auto leavesHomeAndReturns = [&](const char* how) {
    EXPECT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() != home; }))
        << how << " changes nothing";
    viewer.press("space");
    EXPECT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() == home; })) << "after " << how;
  };
  viewer.drag(1, 0.05, 0.85, 0.25, 0.9);  // beside the cloth, wherever that swings
  leavesHomeAndReturns("left drag");
  viewer.drag(3, 0.5, 0.7, 0.6, 0.8);
  leavesHomeAndReturns("right drag");
  viewer.click(4, 3);
  leavesHomeAndReturns("the wheel");
  viewer.press("3");
  leavesHomeAndReturns("the key of the view from above");
}

TEST_F(ViewerUi, F1ShowsTheListOfKeysAndF2HidesThePanel) {
  const ViewerProgram viewer(shownScene);
  viewer.press("p");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused"));
  const auto darkCentre = [&] { return viewer.picture().share(0.3, 0.3, 0.7, 0.7, isDark); };
  const double before = darkCentre();
  viewer.press("F1");
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return darkCentre() > before + 0.3; }))
      << before << " to " << darkCentre();
  viewer.press("F1");
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return darkCentre() < before + 0.1; }));

  const Picture with = viewer.stillPicture();
  viewer.press("F2");
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() != with; }));
  viewer.press("F2");
  EXPECT_TRUE(test::eventually(seconds(20), [&] { return viewer.picture() == with; }));
}

TEST_F(ViewerUi, EscEndsItAtOnceWithExitCodeZeroAndNoFilesLeftBehind) {
  ViewerProgram viewer(std::string(shownScene) + " --backend gpu");
  viewer.press("Escape");
  EXPECT_EQ(viewer.exitCodeWithin(seconds(5)), 0) << viewer.output();
  EXPECT_TRUE(viewer.leftNoFiles()) << "imgui.ini, perhaps";
  EXPECT_EQ(viewer.output().find("OpenGL"), std::string::npos) << "the driver complains: " << viewer.output();
}

TEST_F(ViewerUi, OnAScreenWithoutOpenGl45SaysWhatWasFoundAndWhatIsNeededAndEndsWithExitCodeFour) {
  for (const char* limit :
       {"MESA_GL_VERSION_OVERRIDE=4.2", "LIBGL_DRIVERS_PATH=/nonexistent", "GALLIUM_DRIVER=softpipe"}) {
    const test::CommandResult result =
        test::runCommand(std::string("env ") + limit + " " CLOTHSIM_PROGRAM " -f pinned2 2>&1");
    EXPECT_EQ(result.exitCode, 4) << result.output;
    for (const char* part : {"found:", "needed:    OpenGL 4.5", "clothsim run --backend cpu"})
      EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  }
}

TEST(ViewerWithoutAScreen, NamesTheCommandsThatNeedNoneAndEndsWithExitCodeFour) {
  const test::CommandResult result =
      test::runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " CLOTHSIM_PROGRAM " -f pinned2 2>&1");
  EXPECT_EQ(result.exitCode, 4) << result.output;
  EXPECT_NE(result.output.find("clothsim render -f pinned2 --frames 240 --out clip.mp4"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("clothsim run -f pinned2"), std::string::npos) << result.output;
}

TEST_F(ViewerUi, PausesWithAMessageWhenTheWatchdogFindsDivergenceAndRTriesAgain) {
  // The free edge falls at 2 m/s^2: it is too fast after three quarters of a second.
  const ViewerProgram viewer(std::string(shownScene) +
                             " --set gravity=[0,-2,0] --set cloth.damping=0 --set solver.max_speed=1.5");
  ASSERT_TRUE(viewer.titleBecomesOneWith("paused")) << viewer.title();
  const auto isAlert = [](Picture::Pixel p) { return p.r > 180 && p.g > 130 && p.g < 210 && p.b < 120; };
  EXPECT_TRUE(test::eventually(seconds(20), [&] {
    return viewer.picture().share(0, 0.7, 1, 1, isAlert) > 0.005;
  })) << "no message at the bottom";
  EXPECT_GT(viewer.picture().share(0, 0, 1, 1, isClothRed), 0.02)
      << "the last good state is still to be seen";
  viewer.press("r");
  EXPECT_TRUE(viewer.titleBecomesOneWith("fps")) << viewer.title();
  EXPECT_TRUE(viewer.titleBecomesOneWith("paused")) << "it happens again: " << viewer.title();
}

}  // namespace
}  // namespace clothsim
