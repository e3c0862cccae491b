// What a program can do that links no OpenGL: load a scene, step it, measure it, save it, and go on from what
// was saved.
#include "simulation/simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"
#include "scene_io/scene_options.h"
#include "session/replay.h"
#include "simulation/compare.h"
#include "simulation/run_summary.h"
#include "simulation/saved_files.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

Scene smallScene(const std::string& name = "pinned2") {
  SceneOptions options{.scene = name, .resolution = GridSize{9, 9}};
  options.settings = {"solver.simulation_steps=8"};
  return readScene(options).scene;
}

std::string hashOf(Simulation& simulation) { return hashText(stateHash(simulation.state())); }

TEST(SceneOptions, RefuseANumberOfPointsBesideAResolution) {
  SceneOptions options{.scene = "pinned2", .resolution = GridSize{9, 9}};
  options.settings = {"cloth.num_width_points=17"};
  EXPECT_THROW((void)readScene(options), UsageError);
}

TEST(SceneOptions, NameImplicitStepsWhereExplicitOnesBecomeVerySmall) {
  const auto namesImplicit = [](int side) {
    const RemarkedScene read =
        readScene({.scene = "demo", .resolution = GridSize{side, side}, .settings = {"cloth.material=silk"}});
    return read.remarks.back().find("solver.integrator=implicit takes larger ones") != std::string::npos;
  };
  EXPECT_FALSE(namesImplicit(9));
  EXPECT_TRUE(namesImplicit(97));
}

TEST(SceneOptions, TellOfSettingsThatChangeNothing) {
  const auto remarksOf = [](const char* scene, std::vector<std::string> given) {
    given.push_back("solver.simulation_steps=8");
    return readScene({.scene = scene, .settings = given}).remarks;
  };
  EXPECT_EQ(remarksOf("pinned2", {}), std::vector<std::string>{});
  const std::vector<std::string> idle =
      remarksOf("pinned2", {"cloth.reference_length=0.2", "solver.self_friction=0.2"});
  ASSERT_EQ(idle.size(), 2u);
  EXPECT_EQ(idle[0], "cloth.reference_length changes nothing without stiffness_reference");
  EXPECT_EQ(idle[1],
            "solver.self_friction changes nothing where self_collision is averaged; robust and contact have "
            "friction");
  EXPECT_EQ(remarksOf("cs171", {"cloth.reference_length=0.2", "solver.self_collision=robust",
                                "solver.self_friction=0.2"}),
            std::vector<std::string>{});
}

TEST(Simulation, IsLoadedSteppedAndMeasuredWithoutOpenGl) {
  Simulation simulation(smallScene());
  RunSummary summary;
  summary.add(simulation);
  for (int frame = 1; frame <= 3; ++frame) {
    simulation.stepFrame();
    ASSERT_FALSE(simulation.checkFrame());
    summary.add(simulation);
  }
  EXPECT_EQ(simulation.solver().stepIndex(), 24u);
  EXPECT_NEAR(simulation.time(), 3 / 90.0, 1e-12);
  EXPECT_EQ(summary.frame, 3);
  // A horizontal sheet has begun to fall.
  EXPECT_LT(summary.measures.minY, Simulation(smallScene()).cloth().positions()[0].y);
  nlohmann::ordered_json json;
  summary.write(json, simulation);
  EXPECT_EQ(json["state_hash"], hashOf(simulation));
  EXPECT_GT(json["kinetic_energy"].get<double>(), 0);
}

TEST(Simulation, GoesOnFromASavedStateToTheBit) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "third.state").string();
  Simulation whole(smallScene("cs171"));
  SavedFiles saved({file}, 1, 3, whole);
  for (int frame = 0; frame <= 3; ++frame) {
    if (frame > 0) whole.stepFrame();
    saved.add(whole, whole.state(), frame);
  }
  saved.finish();
  whole.stepFrames(2);

  Simulation later(smallScene("cs171"));
  const std::uint64_t version = later.version();
  later.setState(loadState(file, later.cloth()));
  EXPECT_NE(later.version(), version) << "whoever draws it must learn that it is another state";
  later.stepFrames(2);
  EXPECT_EQ(hashOf(later), hashOf(whole));
}

TEST(Simulation, SavesEveryKindOfFileWithoutPictures) {
  const test::TemporaryFolder folder;
  const auto name = [&](const char* file) { return (folder / file).string(); };
  Simulation simulation(smallScene());
  SavedFiles saved({name("all.pc2"), name("all.usda"), name("last.csv"), name("%02d.obj")}, 2, 3, simulation,
                   10);
  for (int frame = 0; frame <= 3; ++frame) {
    if (frame > 0) simulation.stepFrame();
    saved.add(simulation, simulation.state(), frame);
  }
  saved.finish();
  for (const char* file : {"all.pc2", "all_rest.obj", "all.usda", "last.csv", "10.obj", "12.obj"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(folder / "11.obj")) << "only every second frame was asked for";
  EXPECT_FALSE(std::filesystem::exists(folder / "13.obj"));
  EXPECT_NE(readFile(folder / "all.usda").find("startTimeCode = 10\n    endTimeCode = 12\n"),
            std::string::npos);
  EXPECT_THROW(SavedFiles({name("picture.png")}, 1, 1, simulation), UsageError);
}

TEST(Simulation, SequencesOfARunThatEndsEarlyAreCompleteWithItsFrames) {
  const test::TemporaryFolder folder;
  const auto name = [&](const char* file) { return (folder / file).string(); };
  Simulation simulation(smallScene());
  SavedFiles saved({name("all.pc2"), name("all.usda"), name("last.csv")}, 1, 9, simulation);
  for (int frame = 0; frame <= 1; ++frame) saved.add(simulation, simulation.state(), frame);
  saved.finish();
  EXPECT_EQ(readFile(folder / "all.pc2").size(), 32 + 2 * 12 * simulation.state().positions.size());
  EXPECT_NE(readFile(folder / "all.usda").find("endTimeCode = 1\n"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "last.csv"));
}

TEST(ForeignFrameNumber, IsWhatOtherProgramsCountFramesWith) {
  EXPECT_EQ(foreignFrameNumber("out/x_%4d.obj"), "%4d");
  EXPECT_EQ(foreignFrameNumber("y_####.obj"), "####");
  EXPECT_EQ(foreignFrameNumber("z_$F4.obj"), "$F4");
  EXPECT_EQ(foreignFrameNumber("w_%04i.obj"), "%04i");
  for (const char* name : {"x_%04d.obj", "%d.obj", "take#2.obj", "50%.obj", "still.png", "price$.obj"})
    EXPECT_EQ(foreignFrameNumber(name), "") << name;
}

TEST(Simulation, IsBackAtTheLastSoundStateAfterDivergence) {
  Scene scene = smallScene();
  Simulation simulation(scene);
  simulation.stepFrame();
  ASSERT_FALSE(simulation.checkFrame());
  const std::string sound = hashOf(simulation);
  scene.gravity.y = -1e9;
  simulation.configure(scene);
  simulation.stepFrames(5);
  const std::optional<Divergence> divergence = simulation.checkFrame();
  ASSERT_TRUE(divergence);
  EXPECT_EQ(hashOf(simulation), sound);
  EXPECT_TRUE(blowUpText(*divergence, simulation.cloth(), simulation.scene())
                  .starts_with("the simulation blew up: in step "));
}

TEST(Simulation, SaysWhichBackendsThereAreAndKeepsTheOneItHas) {
  Simulation simulation(smallScene());
  simulation.stepFrame();
  const std::string before = hashOf(simulation);
  try {
    simulation.switchBackend("gpu");
    FAIL() << "there is no GPU solver in this library";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "there is no backend \"gpu\" here; expected cpu");
  }
  EXPECT_EQ(hashOf(simulation), before);
  simulation.switchBackend("cpu");
  EXPECT_EQ(hashOf(simulation), before);
}

TEST(Simulation, SharesItsSceneAndClothWithWhoAsks) {
  const Shared<Scene> scene = smallScene();
  Simulation simulation(scene);
  EXPECT_TRUE(simulation.sharedScene().isSameAs(scene)) << "no copy";
  const Shared<Cloth> cloth = simulation.sharedCloth();
  Scene finer = *scene;
  finer.cloths[0].numWidthPoints = 11;
  simulation.rebuild(finer);
  EXPECT_EQ(cloth->particleCount(), 81u) << "it stays what it was for who holds it";
  EXPECT_EQ(simulation.cloth().particleCount(), 99u);
}

TEST(Simulation, ComparesTwoSolversOfAnyFactory) {
  const auto bothOnTheCpu = [](const std::string&, const Shared<Cloth>& cloth, const Shared<Scene>& scene) {
    return makeCpuSolver("cpu", cloth, scene);
  };
  const Comparison same = compareBackends(smallScene(), 2, bothOnTheCpu);
  EXPECT_EQ(same.differingFloats, 0u);
  EXPECT_EQ(same.floats, 6u * 81u);
  const auto oneIsLate = [](const std::string& backend, const Shared<Cloth>& cloth,
                            const Shared<Scene>& scene) {
    Scene slower = *scene;
    if (backend == "gpu") slower.gravity.y *= 0.5;
    return makeCpuSolver("cpu", cloth, slower);
  };
  const Comparison other = compareBackends(smallScene(), 2, oneIsLate);
  EXPECT_GT(other.differingFloats, 0u);
  EXPECT_EQ(other.firstDifferingStep, 1u);
}

TEST(Simulation, RepeatsARecordingWithoutOpenGl) {
  Session session(smallScene(), "cpu", makeCpuSolver);
  session.act(Grab{.particle = 40, .target = {0.5, 1.2, 0.5}});
  ASSERT_FALSE(session.stepFrames(3));
  Replay replay(Recording::parse(session.recording().format(), "recorded"), std::nullopt, makeCpuSolver);
  for (int frame = 0; frame < 3; ++frame) ASSERT_FALSE(replay.stepFrame());
  EXPECT_EQ(hashOf(replay.session().simulation()), hashOf(session.simulation()));
  EXPECT_NE(hashOf(session.simulation()), [] {
    Simulation untouched(smallScene());
    untouched.stepFrames(3);
    return hashOf(untouched);
  }());
  EXPECT_TRUE(replay.remarks().empty());
}

TEST(Simulation, SaysWhichActionsOfARecordingItCouldNotDoInTime) {
  Session session(smallScene(), "cpu", makeCpuSolver);
  ASSERT_FALSE(session.stepFrames(2));
  Recording recording = session.recording();
  const std::uint64_t frame = session.step() / 2;
  for (const std::uint64_t step : {frame - 1, 5 * frame})
    recording.events.push_back({.step = step, .action = Grab{.particle = 40, .target = {0.5, 1.2, 0.5}}});
  Replay replay(recording, std::nullopt, makeCpuSolver);
  for (int i = 0; i < 2; ++i) ASSERT_FALSE(replay.stepFrame());
  ASSERT_EQ(replay.remarks().size(), 2u);
  EXPECT_NE(replay.remarks()[0].find("1 of its actions lie within a frame"), std::string::npos);
  EXPECT_NE(replay.remarks()[1].find("1 of its actions come after its 2 frames"), std::string::npos);
}

}  // namespace
}  // namespace clothsim
