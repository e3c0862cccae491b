// Parts of the viewer that need no window.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdio>
#include <cstdlib>
#include <set>

#include "core/error.h"
#include "core/files.h"
#include "gl/gl_test.h"
#include "gl/viewer/small_scene.h"
#include "output/clip_recorder.h"
#include "output/numbered_files.h"
#include "scene_io/mesh_scene.h"
#include "scene_io/scene_io.h"
#include "session/session.h"
#include "solver/state.h"
#include "support/temporary_folder.h"
#include "viewer/compare_card.h"
#include "viewer/folder_list.h"
#include "viewer/input_queue.h"
#include "viewer/kept_picture.h"
#include "viewer/mouse_tools.h"
#include "viewer/viewer.h"
#include "viewer/viewer_config.h"
#include "viewer/viewer_facts.h"
#include "viewer/viewer_keys.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

// Sets a variable of the environment for as long as it lives.
class ChangedEnvironment {
 public:
  ChangedEnvironment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value == nullptr ? ::unsetenv(name) : ::setenv(name, value, 1);
  }
  ~ChangedEnvironment() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }
  ChangedEnvironment(const ChangedEnvironment&) = delete;
  ChangedEnvironment& operator=(const ChangedEnvironment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(ViewerKeys, EachInputStandsInTheTableOnce) {
  std::set<std::string_view> inputs;
  for (const ViewerKey& key : viewerKeys) EXPECT_TRUE(inputs.insert(key.input).second) << key.input;
}

TEST(ViewerKeys, EachActionIsFoundByItsOwnKey) {
  for (const ViewerKey& key : viewerKeys) {
    if (key.action == ViewerAction::none) continue;
    EXPECT_EQ(actionOf(keyStroke(key.input)), key.action) << key.input;
  }
}

TEST(ViewerKeys, CS184sKeysDoWhatTheyDidThere) {
  EXPECT_EQ(actionOf({"P"}), ViewerAction::pause);
  EXPECT_EQ(actionOf({"N"}), ViewerAction::stepFrame);
  EXPECT_EQ(actionOf({"R"}), ViewerAction::restart);
  EXPECT_EQ(actionOf({"Space"}), ViewerAction::resetCamera);
  EXPECT_EQ(actionOf({"Esc"}), ViewerAction::quit);
}

TEST(ViewerKeys, ControlAndShiftMakeOtherStrokesOfAKey) {
  EXPECT_EQ(actionOf({"P", true, false}), ViewerAction::screenshot);
  EXPECT_EQ(actionOf({"Z"}), ViewerAction::none);
  EXPECT_EQ(actionOf({"Z", true, false}), ViewerAction::undo);
  EXPECT_EQ(actionOf({"Z", true, true}), ViewerAction::redo);
}

TEST(ViewerKeys, HelpHasEveryLineOfTheTable) {
  const std::string help = viewerKeysText();
  for (const ViewerKey& key : viewerKeys) {
    EXPECT_NE(help.find("  " + std::string(key.input) + "  "), std::string::npos) << key.input;
    EXPECT_NE(help.find("  " + std::string(key.effect) + "\n"), std::string::npos) << key.effect;
  }
}

using Kind = InputEvent::Kind;
constexpr int letGo = 0, pressed = 1, enterKey = 257, controlKey = 341;

TEST(InputBetweenFrames, IsPressedInOneFrameAndLetGoInTheNext) {
  InputQueue queue;
  queue.add({.kind = Kind::key, .code = '1', .action = pressed});  // its character says as much
  queue.add({.kind = Kind::character, .code = '1'});
  queue.add({.kind = Kind::key, .code = '1', .action = letGo});
  queue.add({.kind = Kind::key, .code = enterKey, .action = pressed});
  queue.add({.kind = Kind::key, .code = enterKey, .action = letGo});
  const std::vector<InputEvent> first = queue.takeFrame();
  ASSERT_EQ(first.size(), 3u);
  EXPECT_EQ(first[0].kind, Kind::character);
  EXPECT_EQ(first[2].code, enterKey);
  EXPECT_EQ(first[2].action, pressed);
  EXPECT_FALSE(queue.isEmpty());
  const std::vector<InputEvent> second = queue.takeFrame();
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].code, enterKey);
  EXPECT_EQ(second[0].action, letGo);
  EXPECT_TRUE(queue.isEmpty());
}

TEST(InputBetweenFrames, ClicksWithTheModifiersThatWereHeld) {
  InputQueue queue;
  queue.add({.kind = Kind::key, .code = controlKey, .action = pressed});
  ASSERT_EQ(queue.takeFrame().size(), 1u);
  queue.add({.kind = Kind::button, .code = 0, .action = pressed});
  queue.add({.kind = Kind::button, .code = 0, .action = letGo});
  queue.add({.kind = Kind::key, .code = controlKey, .action = letGo});
  EXPECT_EQ(queue.takeFrame().size(), 1u) << "the press alone";
  const std::vector<InputEvent> last = queue.takeFrame();
  ASSERT_EQ(last.size(), 2u);
  EXPECT_EQ(last[1].code, controlKey);
}

using CompareCardTest = GlTest;

TEST_F(CompareCardTest, GoesAwayAWhileAfterItsResult) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 4;
  Session session(scene, "cpu", makeCpuSolver);
  CompareCard card;
  card.start(session);
  while (card.isRunning()) {
    card.pass(3600);
    ASSERT_TRUE(card.isOpen()) << "while it runs it stays";
    card.advance();
  }
  card.pass(5);
  EXPECT_TRUE(card.isOpen());
  card.pass(10);
  EXPECT_FALSE(card.isOpen());
}

TEST(ViewerConfigFile, IsReadAsItWasWritten) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "a" / "b" / "viewer.json";
  ViewerConfig config;
  config.showPanels = false;
  config.showOverlay = false;
  config.panel = PanelName::look;
  config.textSize = 1.25;
  config.folder = "/home/somebody/scenes";
  EXPECT_EQ(saveViewerConfig(config, path), "");
  const LoadedConfig loaded = loadViewerConfig(path);
  EXPECT_EQ(loaded.config, config);
  EXPECT_EQ(loaded.notice, "");
}

TEST(ViewerConfigFile, ThatIsMissingMeansDefaultsAndNoNotice) {
  const test::TemporaryFolder folder;
  const LoadedConfig loaded = loadViewerConfig(folder / "viewer.json");
  EXPECT_EQ(loaded.config, ViewerConfig{});
  EXPECT_EQ(loaded.notice, "");
}

TEST(ViewerConfigFile, ThatIsNoneIsPassedOverWithANoticeThatNamesIt) {
  const test::TemporaryFolder folder;
  for (const char* text : {"{\"show_panels\": ", "[1, 2]", "{\"panel\": 3}", "\xff\xfe"}) {
    writeFileAtomically(folder / "viewer.json", text);
    const LoadedConfig loaded = loadViewerConfig(folder / "viewer.json");
    EXPECT_EQ(loaded.config, ViewerConfig{}) << text;
    EXPECT_NE(loaded.notice.find("viewer.json"), std::string::npos) << text;
  }
  fs::remove(folder / "viewer.json");
  fs::create_directory(folder / "viewer.json");
  EXPECT_NE(loadViewerConfig(folder / "viewer.json").notice, "");
}

TEST(ViewerConfigFile, LiesInTheUsersFolderOfConfiguration) {
  const ChangedEnvironment home("HOME", "/home/somebody");
  {
    const ChangedEnvironment xdg("XDG_CONFIG_HOME", "/elsewhere");
    EXPECT_EQ(viewerConfigPath(), "/elsewhere/clothsim/viewer.json");
  }
  {
    const ChangedEnvironment relative("XDG_CONFIG_HOME", "not/absolute");
    EXPECT_EQ(viewerConfigPath(), "/home/somebody/.config/clothsim/viewer.json");
  }
  const ChangedEnvironment none("XDG_CONFIG_HOME", nullptr), homeless("HOME", nullptr);
  EXPECT_EQ(viewerConfigPath(), "");
  EXPECT_NE(saveViewerConfig({}, viewerConfigPath()), "");
}

TEST(ViewerConfigFile, ThatCannotBeWrittenIsATroubleInWordsAndNoCrash) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "file", "no folder");
  EXPECT_NE(saveViewerConfig({}, folder / "file" / "clothsim" / "viewer.json"), "");
}

TEST(KeptPicture, IsThatOfItsKeyDrawnAsSharplyAsIsWanted) {
  KeptPicture kept;
  PictureKey key{.width = 4, .height = 3, .time = 1, .version = 2};
  EXPECT_FALSE(kept.isOf(key, 0.5));
  kept.drawn(key, 0.75);
  EXPECT_TRUE(kept.isOf(key, 0.5));
  EXPECT_FALSE(kept.isOf(key, 1));
  for (const PictureKey& other : {PictureKey{.width = 5, .height = 3, .time = 1, .version = 2},
                                  PictureKey{.width = 4, .height = 3, .time = 1.1, .version = 2},
                                  PictureKey{.width = 4, .height = 3, .time = 1, .version = 3}})
    EXPECT_FALSE(kept.isOf(other, 0.5));
  EXPECT_TRUE(kept.looksLike({.width = 4, .height = 3, .time = 1.1, .version = 3}, 0.75))
      << "of another state";
  EXPECT_FALSE(kept.looksLike({.width = 5, .height = 3, .time = 1, .version = 2}, 0.75));
  EXPECT_FALSE(kept.looksLike(key, 1));
  key.options.showPins = true;
  EXPECT_FALSE(kept.isOf(key, 0.5));
  key.options.showPins = false;
  kept.forget();
  EXPECT_FALSE(kept.isOf(key, 0.5));
}

TEST(RefinedPicture, BeginsAnewWhenThePictureIsAnother) {
  RefinedPicture refined;
  PictureKey key{.width = 640, .height = 480};
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(refined.exposuresOf(key), std::min(i, 3));
    refined.exposed(3);
  }
  key.width = 800;
  EXPECT_EQ(refined.exposuresOf(key), 0) << "what is exposed has another size";
  refined.exposed(3);
  EXPECT_EQ(refined.exposuresOf(key), 1);
  refined.forget();
  EXPECT_EQ(refined.exposuresOf(key), 0);
}

class ViewerFactsTest : public GlTest {};

TEST_F(ViewerFactsTest, AreThoseOfTheFrameThatIsShownWhileAThreadHasTheSession) {
  OpenScene open(loadSceneByName("pinned2"), "pinned2", "cpu", {});
  ASSERT_FALSE(open.session().stepFrames(2));
  const auto speed = [&] {
    for (const OverlayFacts::Row& row : viewerFacts(open, SpeedMeter{}, true, 1, std::nullopt, {}).rows)
      if (row.label == "speed") return row.value;
    return std::string();
  };
  open.hold();
  open.session().seek(1);  // as the thread does after a frame that blows up
  EXPECT_EQ(speed(), "paused (P: resume)");
  open.release();
  EXPECT_EQ(speed(), "in the past (P: resume)");
}

TEST(FolderList, HasFoldersFirstThenScenesAndMeshesByName) {
  const test::TemporaryFolder folder;
  for (const char* name : {"b.json", "A.OBJ", "notes.txt", ".hidden.json", "c.Json"})
    writeFileAtomically(folder / name, "{}");
  fs::create_directory(folder / "z");
  fs::create_directory(folder / ".git");
  fs::create_symlink("/nonexistent", folder / "gone.json");
  writeFileAtomically(folder / "of_hands.json", R"({"schema": "clothsim-recording/1"})");
  ASSERT_EQ(::mkfifo((folder / "pipe.json").c_str(), 0600), 0);
  const FolderList list = listFolder(folder.path());
  EXPECT_EQ(list.fault, "");
  std::vector<std::string> names;
  for (const FolderEntry& entry : list.entries) names.push_back(entry.name);
  EXPECT_EQ(names, (std::vector<std::string>{"z", "A.OBJ", "b.json", "c.Json", "gone.json", "pipe.json"}));
  EXPECT_EQ(list.entries[0].kind, FileKind::folder);
  EXPECT_EQ(list.entries[1].kind, FileKind::mesh);
  EXPECT_EQ(list.entries[2].bytes, 2u);
  EXPECT_EQ(list.entries[4].bytes, 0u) << "a link that leads nowhere";
  EXPECT_NE(listFolder(folder / "b.json").fault.find("b.json"), std::string::npos) << "it is no folder";
  EXPECT_TRUE(contains("Drape_Box.json", "BOX"));
  EXPECT_FALSE(contains("Drape_Box.json", "ball"));
}

TEST(MeshScene, HasTheMeshAsClothAboveTheBallOrAsASolidAtItsPlace) {
  const fs::path mesh = fs::path(SOURCE_ROOT) / "assets" / "meshes" / "cushion.obj";
  const Scene scene = sceneOfMesh(mesh);
  const Cloth cloth(scene);
  EXPECT_TRUE(scene.cloths[0].material);
  EXPECT_EQ(scene.solver.selfCollision, SelfCollision::contact) << "as in a file that names a material";
  const auto& ball = std::get<Sphere>(scene.colliders.at(0));
  double lowest = 1e9;
  for (const Vec3d p : cloth.positions()) lowest = std::min(lowest, p.y);
  EXPECT_GT(lowest, ball.origin.y + ball.radius);
  EXPECT_LT(lowest, ball.origin.y + 2 * ball.radius);

  const Scene with = withMeshSolid(test::smallScene(), mesh, {1, 2, 3});
  ASSERT_EQ(with.colliders.size(), test::smallScene().colliders.size() + 1);
  Session session(with, "cpu", makeCpuSolver);
  EXPECT_FALSE(session.stepFrames(1));
  EXPECT_THROW((void)sceneOfMesh("/nonexistent.obj"), SceneError);
}

TEST(MeshScene, GuessesTheUnitOfTheFileFromItsSize) {
  const test::TemporaryFolder folder;
  const auto scaleOf = [&](const std::string& side) {
    writeFileAtomically(folder / "m.obj", "v 0 0 0\nv " + side + " 0 0\nv 0 0 " + side + "\nf 1 3 2\n");
    return loadSceneByName((folder / "m.obj").string()).cloths[0].scale;
  };
  EXPECT_EQ(scaleOf("1.8"), 1);
  EXPECT_EQ(scaleOf("170"), 0.01);
  EXPECT_EQ(scaleOf("1000"), 0.001) << "a disc of 1 m, not of 10 m";
}

TEST(NumberedFiles, NeverNameWhatIsThere) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(freeName(folder.path(), "demo-gpu-7", ".png"), folder / "demo-gpu-7.png");
  writeFileAtomically(folder / "demo-gpu-7.png", "");
  EXPECT_EQ(freeName(folder.path(), "demo-gpu-7", ".png"), folder / "demo-gpu-7-2.png");
  fs::create_symlink("/nonexistent", folder / "demo-gpu-7-2.png");  // even where it leads nowhere
  EXPECT_EQ(freeName(folder.path(), "demo-gpu-7", ".png"), folder / "demo-gpu-7-3.png");
  const std::string tooLong(300, 'x');  // no file can have it; writing it says so
  EXPECT_EQ(freeName(folder.path(), tooLong, ".png"), folder / (tooLong + ".png"));
}

TEST(NumberedFiles, LeaveANameThatIsTooLongToWhoWritesIt) {
  const std::string stem(300, 'x');
  EXPECT_EQ(freeName("/tmp", stem, ".png"), "/tmp/" + stem + ".png");
}

TEST(ClipRecorder, WithoutFfmpegWritesNumberedPicturesThatPlayInRealTime) {
  const test::TemporaryFolder folder;
  const ChangedEnvironment noPrograms("PATH", folder.path().c_str());
  const Image picture{17, 9, std::vector<std::uint8_t>(3 * 17 * 9, 100)};
  ClipRecorder clip(folder.path(), "demo-cpu", 17, 9);
  EXPECT_EQ(clip.width(), 16) << "films want even sizes";
  EXPECT_EQ(clip.height(), 8);
  const Image even{16, 8, std::vector<std::uint8_t>(3 * 16 * 8, 100)};
  for (int frame = 0; frame < 90; ++frame) clip.add(1.0 / 90, [&] { return even; });
  EXPECT_NEAR(clip.seconds(), 1, 0.04);
  EXPECT_NE(clip.finish().find("demo-cpu-frames"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "demo-cpu-frames" / "frame_0029.png"));
  EXPECT_FALSE(fs::exists(folder / "demo-cpu-frames" / "frame_0032.png"));
}

// Pulls the demo's sheet half a metre to the side, at 2 m/s, and holds it for a second while the ball spins.
// Returns the largest strain of a spring.
double strainOfAPull(double strength) {
  Scene scene = loadSceneByName("demo");
  (void)changeResolution(scene, 64, 64, false);
  Session session(scene, "cpu", makeCpuSolver);
  EXPECT_FALSE(session.stepFrames(120));
  const std::uint32_t held = 56 * 64 + 32;
  const Vec3d from = vectorOf(session.simulation().state().positions[held]);
  session.act(Grab{.particle = held, .target = from, .strength = strength, .radius = 0.1});
  const std::vector<Spring> springs = session.simulation().cloth().springs();
  double strain = 0;
  for (int frame = 1; frame <= 75; ++frame) {
    session.act(MoveHand{from + 0.5 * std::min(frame / 15.0, 1.0) * Vec3d{0.7, 0.1, 0.7}});
    EXPECT_FALSE(session.stepFrames(1));
    const Simulation& simulation = session.simulation();
    strain = std::max(strain, energies(simulation.cloth(), springs, simulation.scene(), session.cuts(),
                                       session.simulation().state())
                                  .maxStrain);
  }
  return strain;
}

TEST(Hand, DoesNotOvercomeTheStrainLimit) {
  EXPECT_LT(strainOfAPull(HAND_STRENGTH), 0.2) << "the demo's limit is 0.06 at the end of a round";
  EXPECT_GT(strainOfAPull(1e4), 0.5) << "this pull is one that a stronger hand wins";
}

TEST(SessionPulse, ChangesNoBitHoweverAFrameIsDividedByIt) {
  Session plain(test::smallScene(), "cpu", makeCpuSolver), watched(test::smallScene(), "cpu", makeCpuSolver);
  int polls = 0;
  watched.setPoll([&] {
    ++polls;
    return true;
  });
  for (Session* session : {&plain, &watched}) {
    EXPECT_FALSE(session->stepFrames(3));
    session->act(Grab{.particle = 70, .target = {0.5, 1.2, 0.5}, .strength = 1e4, .radius = 0.2});
    EXPECT_FALSE(session->stepFrames(3));
  }
  EXPECT_EQ(stateHash(plain.simulation().solver().state()), stateHash(watched.simulation().solver().state()));
}

TEST(SessionPulse, ThatSaysNoEndsSteppingAndLeavesTheFrameBefore) {
  // A frame of so many steps takes longer than the time between two polls.
  Scene scene = loadSceneByName("pinned2");
  scene.solver.simulationSteps = 100000;
  Session session(scene, "cpu", makeCpuSolver);
  const std::uint64_t before = stateHash(session.simulation().solver().state());
  session.setPoll([] { return false; });
  EXPECT_FALSE(session.stepFrames(2));
  EXPECT_EQ(session.frame(), 0);
  EXPECT_EQ(session.step(), 0u);
  EXPECT_EQ(stateHash(session.simulation().solver().state()), before);
}

}  // namespace
}  // namespace clothsim
