// How the program ends before its time: blown up, or interrupted.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "core/files.h"
#include "support/process.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

using nlohmann::json;
using test::clothsim;
using test::CommandResult;
using test::jsonOf;

TEST(Program, SaysHowToGoOnAfterAnExplosionWithSettingsThatAreStable) {
  const test::TemporaryFolder folder;
  const CommandResult run = clothsim(
      "run -f pinned2 --resolution 25x25 --set cloth.material=silk --set solver.integrator=verlet "
      "--set solver.simulation_steps=3 --backend cpu --frames 5 --save " +
      (folder / "end.csv").string());
  EXPECT_EQ(run.exitCode, 1) << run.output;
  const std::string beginning = "To go on from it: clothsim ";
  const std::size_t at = run.output.find(beginning);
  ASSERT_NE(at, std::string::npos) << run.output;
  const std::size_t from = at + beginning.size();
  const CommandResult on = clothsim(run.output.substr(from, run.output.find('\n', from) - from));
  EXPECT_EQ(on.exitCode, 0) << on.output;
}

TEST(Program, FailsWithOneWhenTheSimulationBlowsUp) {
  const test::TemporaryFolder folder;  // also of the last good state
  const CommandResult result = clothsim(
      "run -f pinned2 --frames 50 --backend cpu --set cloth.ks=1e9 --set solver.strain_limit=false --save " +
      (folder / "end.csv").string() + " --trace " + (folder / "trace.csv").string());
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.output.find("solver.simulation_steps"), std::string::npos) << result.output;
  EXPECT_NE(readFile(folder / "trace.csv").find("\n0,"), std::string::npos) << "the frames before are kept";
  const json summary = jsonOf(
      "run -f pinned2 --frames 50 --backend cpu --set cloth.ks=1e7 --set solver.simulation_steps=1 --json "
      "--save " +
          (folder / "end.csv").string(),
      "", 1);
  EXPECT_EQ(summary["frames"], 1);
  EXPECT_EQ(summary["steps"], 1);
  EXPECT_EQ(summary["finite"], false);
  EXPECT_EQ(summary["divergence"]["frame"], 2);
  EXPECT_NE(summary["divergence"]["text"].get<std::string>().find("pass integrate"), std::string::npos);
}

TEST(Program, SavesTheLastGoodStateOfAnExplosionAndNothingThatIsNotFinite) {
  for (const std::string backend : {"cpu", "gpu"}) {
    const test::TemporaryFolder folder;
    const std::string scene =
        "-f pinned2 --set cloth.ks=1e7 --set solver.simulation_steps=1 --backend " + backend;
    const CommandResult run =
        clothsim("run " + scene + " --frames 50 --save " + (folder / "frame_%04d.csv").string());
    EXPECT_EQ(run.exitCode, 1);
    for (const char* part :
         {"step 2 (frame 2)", "pass integrate", "(cloth 0, column ", "max_speed", "--from "})
      EXPECT_NE(run.output.find(part), std::string::npos) << part << " in:\n" << run.output;
    const std::filesystem::path saved = folder / "pinned2-frame1-last-good.state";
    ASSERT_TRUE(std::filesystem::exists(saved)) << run.output;
    EXPECT_EQ(folder.fileCount(), 3) << "frames 0 and 1, and the last good state";
    for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
      if (file.path().extension() != ".csv") continue;
      const std::string text = readFile(file.path());
      EXPECT_EQ(text.find("nan"), std::string::npos) << file.path();
      EXPECT_EQ(text.find("inf"), std::string::npos) << file.path();
    }
    const json from = jsonOf("run " + scene + " --frames 0 --json --from " + saved.string());
    EXPECT_EQ(from["state_hash"], jsonOf("run " + scene + " --frames 1 --json")["state_hash"]);
  }
}

TEST(Program, KeepsTheFramesBeforeAnExplosionAndGoesOnBesideThem) {
  const test::TemporaryFolder folder;
  const std::string at = folder.path().string() + "/";
  const CommandResult run = clothsim(
      "run -f pinned2 --resolution 16x16 --set cloth.ks=1e7 --set solver.simulation_steps=1 --backend cpu "
      "--frames 9 --first-frame 4 --save " +
      at + "a.pc2 --save " + at + "a.usda --save " + at + "f_%d.obj --save " + at + "end.npz --save " + at +
      "a.mp4");
  EXPECT_EQ(run.exitCode, 1);
  const auto says = [&](const std::string& part) {
    EXPECT_NE(run.output.find(part), std::string::npos) << part << " in:\n" << run.output;
  };
  says("up to frame 2: " + at + "a.pc2 with " + at + "a_rest.obj, " + at + "a.usda");
  says("Not written, for want of a last frame: " + at + "end.npz\n");
  says("--save " + at + "a-from6.pc2 --save " + at + "a-from6.usda --save " + at + "f_%d.obj");
  says("--first-frame 6\n");
  EXPECT_EQ(readFile(folder / "a.pc2").size(), 32 + 3 * 16 * 16 * 12u);
  EXPECT_NE(readFile(folder / "a.usda").find("startTimeCode = 4\n    endTimeCode = 6\n"), std::string::npos);
  EXPECT_EQ(readFile(folder / "a.mp4").substr(4, 4), "ftyp");
}

TEST(Program, DoesNotOverwriteAnotherFileByALastGoodState) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "pinned2-frame1-last-good.state", "dear to somebody");
  const std::string run =
      "run -f pinned2 --set cloth.ks=1e7 --set solver.simulation_steps=1 --backend cpu --frames 9 --save " +
      (folder / "end.csv").string();
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(clothsim(run).exitCode, 1);
    EXPECT_EQ(readFile(folder / "pinned2-frame1-last-good.state"), "dear to somebody");
    EXPECT_TRUE(std::filesystem::exists(folder / "pinned2-frame1-last-good-2.state"));
    EXPECT_EQ(folder.fileCount(), 2) << "the same state is not saved twice";
  }
}

TEST(Program, EndsEveryCommandThatSimulatesWithOneWhenItBlowsUp) {
  const test::TemporaryFolder folder;
  const std::string wild = " -f pinned2 --set cloth.ks=1e7 --set solver.simulation_steps=1";
  for (const std::string& command :
       {"compare --frames 9" + wild, "bench --resolution 20x20 --seconds 0.02" + wild,
        "render --frames 9 --size 64x64 --out " + (folder / "a.png").string() + wild}) {
    const CommandResult result = clothsim(command);
    EXPECT_EQ(result.exitCode, 1) << command;
    EXPECT_NE(result.output.find("blew up: in step"), std::string::npos) << command << "\n" << result.output;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(Program, ComparesTheFramesBeforeAnExplosionAndSaysWhichItWas) {
  const json summary = jsonOf(
      "compare -f pinned2 --resolution 12x12 --frames 9 --set cloth.ks=1e7 --set solver.simulation_steps=1 "
      "--json",
      "", 1);
  const int frames = summary["frames"];
  EXPECT_LT(frames, 9);
  EXPECT_EQ(summary["steps"], frames);
  EXPECT_EQ(summary["divergence"]["frame"], frames + 1);
  EXPECT_EQ(summary["divergence"]["cpu"], summary["divergence"]["gpu"]);
  EXPECT_NE(summary["divergence"]["cpu"].get<std::string>().find("pass integrate"), std::string::npos);
}

TEST(Program, FinishesTheFilmWhenItIsInterrupted) {
  const test::TemporaryFolder folder;
  const std::string film = (folder.path() / "clip.mp4").string();
  test::Process render({CLOTHSIM_PROGRAM, "render", "-f", "pinned2", "--resolution", "16x16", "--frames",
                        "100000", "--size", "96x64", "--out", film},
                       "/dev/null");
  ASSERT_TRUE(folder.getsAFile());
  ASSERT_EQ(folder.fileCount(), 1) << "the film grows under a temporary name";
  ASSERT_FALSE(std::filesystem::exists(film));
  render.send(SIGINT);
  EXPECT_EQ(render.waitFor(std::chrono::seconds(30)), 130);
  EXPECT_EQ(folder.fileCount(), 1);
  EXPECT_EQ(readFile(film).substr(4, 4), "ftyp");
}

}  // namespace
}  // namespace clothsim
