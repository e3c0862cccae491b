// Everything done to a simulation by hand, looked back at, and done again.
#include "session/session.h"
#include "simulation/gpu/solvers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "gl/gl_test.h"
#include "scene_io/json_tree.h"
#include "scene_io/scene_io.h"
#include "session/replay.h"
#include "support/compared_scenes.h"
#include "support/mesh_sheet.h"
#include "support/temporary_folder.h"
#include "support/throws.h"

namespace clothsim {
namespace {

using SessionTest = GlTest;
using test::messageThrownBy;

Scene fewSteps(Scene scene) {
  scene.solver.simulationSteps = 10;
  return scene;
}
Scene sheet(int n = 12) {
  Scene scene = fewSteps(test::vertical(test::sheetScene(n)));
  scene.colliders = {
      Sphere{.origin = {0.5, 0.5, 0.5}, .radius = 0.2, .friction = 0.5, .motion = std::nullopt}};
  return scene;
}

std::uint64_t hashOf(Session& session) { return stateHash(session.simulation().solver().state()); }

void stepSoundly(Session& session, int frames) { ASSERT_EQ(session.stepFrames(frames), std::nullopt); }

// Grabs, moves, cuts, blows, pins, pushes the sphere, edits, lets go. `switches`: B is pressed in mid-swing.
void play(Session& session, bool switches = false) {
  const auto toggle = [&] {
    if (switches)
      session.act(SwitchBackend{session.simulation().solver().backend() == "gpu" ? "cpu" : "gpu"});
  };
  stepSoundly(session, 2);
  session.act(Grab{5, {0.5, 0.2, 0.3}, 1e5, 0.2});
  stepSoundly(session, 1);
  toggle();
  session.act(MoveHand{{0.4, 0.3, 0.4}});
  stepSoundly(session, 2);
  session.act(CutStroke{0, {3.5, -1}, {5.2, 7.3}});
  toggle();
  session.act(SetPin{60, true});
  session.act(Blow{{0.5, 0.5, -1}, {0, 0, 1}, 6, 0.3});
  stepSoundly(session, 2);
  session.act(MoveCollider{0, {0.5, 0.45, 0.15}});
  session.act(TurnCollider{0, {0, 40, 0}});
  stepSoundly(session, 1);
  Scene edited = session.simulation().scene();
  edited.gravity = {0, -5, 1};
  edited.solver.integrator = Integrator::euler;
  edited.cloths[0].pressure = 20;
  edited.cloths[0].tearStrain = 0.05;
  session.act(EditScene{edited});
  session.act(Blow{});
  stepSoundly(session, 2);
  toggle();
  session.act(Release{});
  session.act(SetPin{60, false});
  session.undo();
  stepSoundly(session, 3);
}

TEST_F(SessionTest, GivesTheSameBitsOnBothBackendsAndWhenToggledInMidSwing) {
  for (const Scene& scene : {sheet(), fewSteps(test::layeredSheets(12, SelfCollision::robust))}) {
    Scene played = scene;
    if (played.colliders.empty()) played.colliders = sheet().colliders;
    Session cpu(played, "cpu", makeSolver), gpu(played, "gpu", makeSolver),
        toggled(played, "cpu", makeSolver);
    play(cpu);
    play(gpu);
    play(toggled, true);
    EXPECT_EQ(hashOf(gpu), hashOf(cpu));
    EXPECT_EQ(hashOf(toggled), hashOf(cpu));
    EXPECT_EQ(toggled.cuts(), cpu.cuts());
    EXPECT_EQ(toggled.frame(), 13);
    EXPECT_EQ(toggled.step(), 130u);
  }
}

TEST_F(SessionTest, ReplaysItsRecordingToTheBit) {
  Session live(sheet(), "gpu", makeSolver);
  play(live, true);
  const test::TemporaryFolder folder;
  live.recording().save(folder / "a.json");
  const Recording loaded = Recording::load(folder / "a.json");
  EXPECT_EQ(loaded.frames, 13);
  EXPECT_EQ(*loaded.scene, *live.recording().scene);
  ASSERT_EQ(loaded.events.size(), live.recording().events.size());
  for (const std::optional<std::string>& backend :
       {std::optional<std::string>(), std::optional<std::string>("cpu"), std::optional<std::string>("gpu")}) {
    Replay replay(loaded, backend, makeSolver);
    for (int frame = 0; frame < loaded.frames; ++frame) ASSERT_EQ(replay.stepFrame(), std::nullopt);
    EXPECT_EQ(hashOf(replay.session()), hashOf(live)) << backend.value_or("as recorded");
    EXPECT_EQ(replay.session().simulation().solver().backend(), backend.value_or("cpu"));
  }
}

TEST_F(SessionTest, LooksBackAndGoesOnToTheBit) {
  for (const std::string backend : {"cpu", "gpu"}) {
    Session session(sheet(), backend, makeSolver);
    play(session);
    const std::uint64_t end = hashOf(session);
    EXPECT_EQ(session.oldestFrame(), 0);
    EXPECT_EQ(session.newestFrame(), 13);
    session.seek(4);
    EXPECT_TRUE(session.isGrabbing());
    EXPECT_EQ(session.simulation().solver().stepIndex(), 40u);
    session.seek(13);
    EXPECT_EQ(hashOf(session), end);
    EXPECT_FALSE(session.isGrabbing());
    session.seek(10);
    EXPECT_EQ(session.newestFrame(), 13) << "looking forgets nothing";
    EXPECT_FALSE(session.recording().events.empty());
    session.act(MoveHand{{0, 0, 0}});  // nothing is held: no effect
    EXPECT_EQ(session.newestFrame(), 13);
    stepSoundly(session, 3);  // what was done at frame 10 belongs to it
    EXPECT_EQ(hashOf(session), end);
  }
}

TEST_F(SessionTest, ForgetsWhatCameLaterWhenItGoesOnFromTheMiddle) {
  Session session(sheet(), "gpu", makeSolver), other(sheet(), "gpu", makeSolver);
  play(session);
  session.seek(5);
  stepSoundly(session, 2);
  EXPECT_EQ(session.newestFrame(), 7);
  EXPECT_EQ(session.recording().frames, 7);
  Replay replay(session.recording(), "cpu", makeSolver);
  for (int frame = 0; frame < 7; ++frame) ASSERT_EQ(replay.stepFrame(), std::nullopt);
  EXPECT_EQ(hashOf(replay.session()), hashOf(session));
  EXPECT_EQ(session.recording().events.back().step, 50u);
}

TEST_F(SessionTest, KeepsItsRingOverAChangeOfBackends) {
  Session session(sheet(), "gpu", makeSolver);
  std::vector<std::uint64_t> hashes;
  for (int frame = 0; frame < 6; ++frame) {
    hashes.push_back(hashOf(session));
    if (frame == 3) session.act(SwitchBackend{"cpu"});
    stepSoundly(session, 1);
  }
  for (const int frame : {1, 5, 2, 4, 0}) {
    session.seek(frame);
    EXPECT_EQ(hashOf(session), hashes[static_cast<std::size_t>(frame)]) << frame;
  }
}

TEST_F(SessionTest, KeepsWithinItsBudgetAndForgetsTheOldestFirst) {
  const std::size_t frameBytes = 32 * 12 * 12;
  Session session(sheet(), "gpu", makeSolver, 5 * frameBytes);
  stepSoundly(session, 9);
  EXPECT_EQ(session.snapshotBytes(), 5 * frameBytes);
  EXPECT_EQ(session.oldestFrame(), 4);
  session.setSnapshotBudget(2 * frameBytes);
  EXPECT_EQ(session.oldestFrame(), 7);
  session.seek(7);
  session.setSnapshotBudget(0);
  EXPECT_EQ(session.frame(), 7) << "who looks at it still sees it";
  session.seek(9);
  EXPECT_EQ(session.frame(), 9);
  EXPECT_EQ(session.oldestFrame(), 9) << "the last one stays, to go back to after trouble";
}

TEST_F(SessionTest, GoesBackToTheLastSoundFrameAndLetsGoAfterDivergence) {
  for (const std::string backend : {"cpu", "gpu"}) {
    Session session(sheet(), backend, makeSolver);
    stepSoundly(session, 2);
    session.act(Grab{5, {0.5, 0.2, 0.3}, 1e5, 0});
    stepSoundly(session, 1);
    const std::uint64_t good = hashOf(session);
    Scene exploding = session.simulation().scene();
    exploding.solver.maxSpeed = 1e-3;
    session.act(EditScene{exploding});
    EXPECT_TRUE(session.stepFrames(3).has_value());
    EXPECT_EQ(hashOf(session), good);
    EXPECT_EQ(session.frame(), 3);
    EXPECT_FALSE(session.isGrabbing());
    session.undo();
    stepSoundly(session, 2);
    Replay replay(session.recording(), backend, makeSolver);
    for (int frame = 0; frame < 5; ++frame) ASSERT_EQ(replay.stepFrame(), std::nullopt);
    EXPECT_EQ(hashOf(replay.session()), hashOf(session)) << "the trouble left no trace";
  }
}

TEST_F(SessionTest, UndoesAndRedoesEditsOneByOne) {
  Session session(sheet(), "cpu", makeSolver);
  const Scene first = session.simulation().scene();
  Scene second = first, third = first;
  second.gravity = {0, -1, 0};
  third.gravity = {0, -2, 0};
  EXPECT_FALSE(session.canUndo());
  session.act(EditScene{second});
  session.act(EditScene{third}, true);  // the same slider
  session.undo();
  EXPECT_EQ(session.simulation().scene(), first);
  EXPECT_TRUE(session.canRedo());
  session.redo();
  EXPECT_EQ(session.simulation().scene(), third);
  session.undo();
  session.act(EditScene{second});
  EXPECT_FALSE(session.canRedo()) << "another way was taken";
}

TEST_F(SessionTest, UndoesMovesOfCollidersAsEdits) {
  Session session(sheet(), "cpu", makeSolver);
  Scene edited = session.simulation().scene();
  edited.gravity = {0, -1, 0};
  session.act(EditScene{edited});
  const auto origin = [&] { return std::get<Sphere>(session.simulation().scene().colliders[0]).origin; };
  const Vec3d before = origin();
  for (int frame = 1; frame <= 2; ++frame) {
    session.act(MoveCollider{0, {1, 2, 2.0 + frame}}, frame > 1);
    stepSoundly(session, 1);
  }
  session.undo();
  EXPECT_EQ(origin(), before) << "both at once, since the second goes on with the first";
  EXPECT_EQ(session.simulation().scene().gravity, (Vec3d{0, -1, 0})) << "the edit before is another one";
  session.redo();
  EXPECT_EQ(origin(), (Vec3d{1, 2, 4}));
  session.undo();
  session.undo();
  EXPECT_EQ(session.simulation().scene().gravity, (Vec3d{0, -9.8, 0}));
}

TEST_F(SessionTest, PushesTheClothWithAColliderThatIsDragged) {
  for (const std::string backend : {"cpu", "gpu"}) {
    Scene scene = sheet();
    scene.gravity = {0, 0, 0};
    Session session(scene, backend, makeSolver);
    for (int frame = 1; frame <= 10; ++frame) {
      session.act(MoveCollider{0, {0.5, 0.5, 0.5 - 0.05 * frame}});
      stepSoundly(session, 1);
    }
    const State state = session.simulation().solver().state();
    EXPECT_LT(state.positions[5 * 12 + 5].z, -0.15f) << backend;
    const Sphere& sphere = std::get<Sphere>(session.simulation().scene().colliders[0]);
    EXPECT_EQ(sphere.origin, (Vec3d{0.5, 0.5, 0}));
    EXPECT_FALSE(sphere.motion.has_value()) << "it rests";
  }
}

TEST_F(SessionTest, RebuildsInPlaceWhatKeepsItsLattice) {
  Session session(sheet(), "gpu", makeSolver);
  session.act(SetPin{60, true});
  session.act(CutStroke{0, {3.5, -1}, {5.2, 7.3}});
  stepSoundly(session, 3);
  const State before = session.simulation().solver().state();
  Scene heavier = session.simulation().scene();
  heavier.cloths[0].density = 300;
  heavier.cloths[0].pinned = {GridPoint{0, 11}};
  session.act(EditScene{heavier});
  EXPECT_EQ(session.clothGeneration(), 1u);
  const State after = session.simulation().solver().state();
  EXPECT_EQ(stateHash(after), stateHash(before));
  EXPECT_EQ(after.cuts, before.cuts);
  EXPECT_EQ(after.positions[60].w, 0) << "pinned by hand";
  EXPECT_EQ(after.positions[143].w, after.positions[142].w) << "the other corner is free now";
  EXPECT_FLOAT_EQ(after.positions[5].w, before.positions[5].w / 2);
  stepSoundly(session, 2);
  const std::uint64_t end = hashOf(session);
  session.seek(1);
  EXPECT_EQ(session.clothGeneration(), 2u);
  EXPECT_EQ(session.simulation().scene().cloths[0].density, 150);
  session.seek(5);
  EXPECT_EQ(hashOf(session), end);
}

TEST_F(SessionTest, KeepsPinsOnAnotherLattice) {
  Session session(sheet(), "cpu", makeSolver);
  session.act(SetPin{12 * 5 + 11, true});
  stepSoundly(session, 2);
  Scene finer = session.simulation().scene();
  finer.cloths[0].numWidthPoints = 23;
  finer.cloths[0].numHeightPoints = 23;
  finer.cloths[0].pinned = {GridSide::top};
  session.act(EditScene{finer});
  const State state = session.simulation().solver().state();
  EXPECT_EQ(state.positions[23 * 10 + 22].w, 0);
  EXPECT_EQ(state.clock.step, 0u);
  EXPECT_EQ(session.step(), 20u) << "the session's own clock goes on";
  EXPECT_EQ(session.frameSinceStart(), 0) << "another grid begins anew";
  stepSoundly(session, 2);
  session.seek(1);
  EXPECT_EQ(session.simulation().cloth().particleCount(), 144u);
}

TEST_F(SessionTest, RestartsWithoutHandsAndStillLooksBack) {
  Session session(sheet(), "gpu", makeSolver);
  const std::uint64_t start = hashOf(session);
  play(session);
  const std::uint64_t end = hashOf(session);
  session.act(Restart{});
  EXPECT_TRUE(session.cuts().empty());
  EXPECT_EQ(session.frameSinceStart(), 0);
  stepSoundly(session, 1);
  EXPECT_EQ(session.frameSinceStart(), 1);
  EXPECT_EQ(session.frame(), 14) << "over all restarts";
  EXPECT_EQ(session.simulation().solver().stepIndex(), 10u);
  session.seek(12);
  EXPECT_EQ(session.frameSinceStart(), 12) << "of the run before the restart";
  stepSoundly(session, 1);
  EXPECT_EQ(hashOf(session), end) << "as if it had never been restarted";
  session.seek(0);
  EXPECT_EQ(hashOf(session), start);
}

TEST_F(SessionTest, RefusesWhatMakesNoSenseAndChangesNothing) {
  Session session(sheet(), "cpu", makeSolver);
  const auto refusal = [&](const Action& action) {
    return messageThrownBy<UsageError>([&] { session.act(action); });
  };
  EXPECT_NE(refusal(Grab{144, {}, 1e4, 0}).find("no particle 144, expected 0 to 143"), std::string::npos);
  EXPECT_NE(refusal(Grab{1, {}, 0, 0}).find("strength"), std::string::npos);
  EXPECT_NE(refusal(Grab{1, {NAN, 0, 0}, 1, 0}).find("target"), std::string::npos);
  EXPECT_NE(refusal(SetPin{999, true}).find("999"), std::string::npos);
  EXPECT_NE(refusal(CutStroke{1, {}, {}}).find("no cloth 1"), std::string::npos);
  EXPECT_NE(refusal(Blow{{}, {}, 1, 1}).find("direction"), std::string::npos);
  EXPECT_NE(refusal(MoveCollider{1, {}}).find("no collider 1"), std::string::npos);
  EXPECT_NE(refusal(SwitchBackend{"tpu"}).find("tpu"), std::string::npos);
  session.act(Release{});
  session.act(CutStroke{0, {-5, -5}, {-9, -5}});
  EXPECT_TRUE(session.recording().events.empty());
}

TEST(RecordingTest, ReadsBackEveryDigit) {
  const test::TemporaryFolder folder;
  Recording recording;
  recording.scene = sheet();
  recording.backend = "cpu";
  recording.frames = 7;
  recording.events = {{0, Grab{3, {0.1, 1.0 / 3, -1e-17}, 12345.678901234567, 0.2}},
                      {10, MoveHand{{1e300, 2, 3}}},
                      {10, CutStroke{0, {0.1, -0.7}, {3, 4}}},
                      {20, Blow{{1, 2, 3}, {0, 0, 1}, 5, 0.1}},
                      {20, EditScene{sheet(20)}},
                      {70, MoveCollider{0, {0, 1, 2}}},
                      {70, SetPin{4294967295u, false}},
                      {70, SwitchBackend{"gpu"}},
                      {70, Restart{}},
                      {9007199254740991u, Release{}}};
  recording.save(folder / "a.json");
  const Recording back = Recording::load(folder / "a.json");
  back.save(folder / "b.json");
  EXPECT_EQ(readFile(folder / "a.json"), readFile(folder / "b.json"));
  const auto& grab = std::get<Grab>(back.events[0].action);
  EXPECT_EQ(grab.target, (Vec3d{0.1, 1.0 / 3, -1e-17}));
  EXPECT_EQ(grab.strength, 12345.678901234567);
  EXPECT_EQ(*std::get<EditScene>(back.events[4].action).scene, sheet(20));
  EXPECT_EQ(back.events[9].step, 9007199254740991u);
  EXPECT_EQ(back.backend, "cpu");
}

TEST(RecordingTest, NamesFileLineAndPathOfWhatIsWrong) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& events, const std::string& rest = "") {
    writeFileAtomically(folder / "r.json",
                        "{\n\"schema\": \"clothsim-recording/1\", \"backend\": \"cpu\", \"frames\": 3,\n"
                        "\"scene\": {\"cloth\": {}},\n\"events\": " +
                            events + rest + "}");
    return messageThrownBy<SceneError>([&] { (void)Recording::load(folder / "r.json"); });
  };
  const std::string unknown = refusal("[{\"step\": 1, \"action\": \"grap\"}]");
  EXPECT_NE(unknown.find("r.json:4: events.0.action"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("did you mean \"grab\""), std::string::npos) << unknown;
  const std::string target = refusal("[{\"step\": 1, \"action\": \"move_hand\", \"target\": [1, 2]}]");
  EXPECT_NE(target.find("events.0.target: expected [x, y, z], found a list of 2"), std::string::npos)
      << target;
  EXPECT_NE(refusal("[{\"step\": 5, \"action\": \"release\"}, {\"step\": 4, \"action\": \"release\"}]")
                .find("events.1.step: expected at least 5"),
            std::string::npos);
  EXPECT_NE(refusal("[{\"step\": 1, \"action\": \"edit_scene\", \"scene\": {\"cloth\": {\"ks\": -1}}}]")
                .find("events.0.scene.cloth.ks"),
            std::string::npos);
  EXPECT_NE(refusal("[{\"step\": 1, \"action\": \"release\", \"stp\": 1}]").find("unknown key"),
            std::string::npos);
  EXPECT_NE(refusal("[]", ", \"evens\": 1").find("unknown key"), std::string::npos);
  EXPECT_NE(refusal("[").find("r.json:"), std::string::npos);
  EXPECT_NE(
      messageThrownBy<SceneError>([&] { (void)Recording::load(folder / "none.json"); }).find("none.json"),
      std::string::npos);
  const auto refusalOf = [](const std::string& text) {
    return messageThrownBy<SceneError>([&] { (void)Recording::parse(text, "r.json"); });
  };
  EXPECT_EQ(refusalOf(""), "r.json: the file is empty; expected a recording, {...}");
  EXPECT_EQ(refusalOf(R"({"schema": "clothsim/1", "cloth": {}})"),
            "r.json:1: schema: expected a recording, found a scene; -f takes it, without --replay");
}

// Where the counts follow from a mesh its file is missed when the recording is loaded, elsewhere in the
// replay.
TEST(RecordingTest, NamesTheEventWhoseMeshIsMissing) {
  const test::TemporaryFolder folder;
  for (const char* scene :
       {R"({"cloth": {"mesh": "gone.obj"}})", R"({"cloth": {"mesh": "gone.obj", "material": "cotton"}})"}) {
    writeFileAtomically(folder / "r.json",
                        std::string(R"({"schema": "clothsim-recording/1", "backend": "cpu", "frames": 1,
                          "scene": {"cloth": {}}, "events": [{"step": 0, "action": "restart"},
                          {"step": 0, "action": "edit_scene", "scene": )") +
                            scene + "}]}");
    const std::string message = messageThrownBy<SceneError>(
        [&] { Replay(Recording::load(folder / "r.json"), std::nullopt, makeSolver); });
    EXPECT_NE(message.find("r.json: events.1: "), std::string::npos) << message;
    EXPECT_NE(message.find("gone.obj"), std::string::npos) << message;
  }
}

// A slider that is dragged for a while edits the scene with every picture.
TEST(RecordingTest, HasTheLastEditOfADragInAFrame) {
  Session live(sheet(), "cpu", makeSolver);
  const auto drag = [&](double gravity, bool continues) {
    Scene edited = live.simulation().scene();
    edited.gravity = {0, gravity, 0};
    live.act(EditScene{edited}, continues);
  };
  drag(-9, false);
  for (int i = 0; i < 50; ++i) drag(-8 + 0.1 * i, true);
  EXPECT_EQ(live.recording().events.size(), 1u);
  stepSoundly(live, 2);
  drag(1, true);
  EXPECT_EQ(live.recording().events.size(), 2u) << "in another frame";
  drag(2, false);
  EXPECT_EQ(live.recording().events.size(), 3u) << "another drag";
  live.act(SetPin{60, true});
  drag(3, true);
  EXPECT_EQ(live.recording().events.size(), 5u) << "something else was done between";
  stepSoundly(live, 2);
  Replay replay(live.recording(), "cpu", makeSolver);
  for (int frame = 0; frame < 4; ++frame) ASSERT_EQ(replay.stepFrame(), std::nullopt);
  EXPECT_EQ(hashOf(replay.session()), hashOf(live));
  live.undo();
  EXPECT_EQ(live.simulation().scene().gravity.y, 1) << "undone with the drag that it continued";
}

// What makes another cloth, or another step, leaves its trace even where the next edit takes it back.
TEST(RecordingTest, HasEveryEditThatLeavesATrace) {
  Session live(sheet(), "cpu", makeSolver);
  Scene edited = sheet();
  live.act(EditScene{edited});
  edited.solver.integrator = Integrator::euler;
  live.act(EditScene{edited}, true);
  edited.cloths[0].thickness *= 2;
  live.act(EditScene{edited}, true);
  EXPECT_EQ(live.recording().events.size(), 3u);
}

// A drag of an hour.
TEST(RecordingTest, MayHoldMoreValuesThanAScene) {
  std::string text =
      R"({"schema": "clothsim-recording/1", "backend": "cpu", "frames": 0, "scene": {"cloth": {}}, "//": [0)";
  for (std::size_t i = 0; i < MOST_SCENE_VALUES; ++i) text += ",0";
  EXPECT_EQ(Recording::parse(text + R"(], "events": []})", "long").events.size(), 0u);
}

// The steps that a mesh needs are those of its file, also of one that is found beside the recording.
TEST(RecordingTest, ChoosesTheCountsOfMeshesThatItFinds) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "sheet.obj", test::meshSheetText({.columns = 30, .rows = 30, .edge = 0.01}));
  const std::string scene =
      R"({"cloth": {"mesh": "sheet.obj", "material": "cotton"}, "solver": {"integrator": "verlet"}})";
  writeFileAtomically(folder / "scene.json", scene);
  writeFileAtomically(folder / "r.json",
                      R"({"schema": "clothsim-recording/1", "backend": "cpu", "frames": 0, "scene": )" +
                          scene + R"(, "events": []})");
  EXPECT_EQ(Recording::load(folder / "r.json").scene->solver.simulationSteps.count,
            loadScene(folder / "scene.json").solver.simulationSteps.count);
}

// Beside the recording, or by their full path.
TEST(RecordingTest, FindsTheMeshesOfItsScene) {
  const test::TemporaryFolder folder;
  Recording recording;
  Scene scene = sheet();
  scene.colliders = {MeshCollider{.file = "thing.obj"}};
  recording.scene = scene;
  writeFileAtomically(folder / "thing.obj", "");
  recording.save(folder / "r.json");
  const Recording back = Recording::load(folder / "r.json");
  EXPECT_EQ(std::get<MeshCollider>(back.scene->colliders[0]).file, (folder / "thing.obj").string());
}

}  // namespace
}  // namespace clothsim
