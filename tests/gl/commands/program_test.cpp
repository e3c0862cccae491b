// The program as a user meets it: commands, outputs, exit codes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <thread>

#include "core/files.h"
#include "core/vector_set.h"
#include "gl/gl_test.h"
#include "measure/crossings.h"
#include "support/process.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

using nlohmann::json;
using test::clothsim;
using test::CommandResult;
using test::jsonOf;
using test::runCommand;

TEST(Program, SumsARunUpInJson) {
  const json run = jsonOf("run -f pinned2 --resolution 20x20 --frames 6 --backend cpu --json");
  EXPECT_EQ(run["scene"], "pinned2");
  EXPECT_EQ(run["backend"], "cpu");
  EXPECT_EQ(run["particles"], 400);
  EXPECT_EQ(run["springs"], 2 * 19 * 20 + 2 * 19 * 19 + 2 * 18 * 20);
  EXPECT_EQ(run["triangles"], 2 * 19 * 19);
  EXPECT_EQ(run["steps"], 180);
  EXPECT_NEAR(run["dt"].get<double>(), 1.0 / 2700, 1e-12);
  EXPECT_NEAR(run["sim_seconds"].get<double>(), 6.0 / 90, 1e-12);
  EXPECT_EQ(run["state_hash"].get<std::string>().size(), 16u);
  EXPECT_TRUE(run["finite"].get<bool>());
  for (const char* key : {"device", "frames", "seconds", "particle_steps_per_second", "max_strain",
                          "peak_strain", "min_y", "kinetic_energy", "max_penetration"})
    EXPECT_TRUE(run.contains(key)) << key;
  EXPECT_LT(run["min_y"].get<double>(), 1);
}

TEST(Program, SaysThatTheDeviceWasResetAndEndsWithExitCodeFour) {
  // A sanitizer's library would rather come before the one that is preloaded.
  const std::string lost =
      "ASAN_OPTIONS=verify_asan_link_order=0 LOSE_CONTEXT_WHEN=/ LD_PRELOAD=" LOST_CONTEXT;
  for (const char* command : {"run --backend gpu -f pinned2 --frames 3", "compare -f pinned2 --frames 3"}) {
    const CommandResult result = clothsim(std::string(command) + " --resolution 8x8", lost);
    EXPECT_EQ(result.exitCode, 4) << result.output;
    EXPECT_NE(result.output.find("the OpenGL context was lost: the driver reset the GPU"), std::string::npos)
        << result.output;
  }
}

TEST(Program, AdvisesAgainstAveragedSelfCollisionOnceAndOnlyWhereItLeaked) {
  const auto advice = [](const std::string& arguments) {
    const std::string said = clothsim(arguments + " --backend cpu").output;
    int count = 0;
    for (std::size_t at = 0; (at = said.find("self_collision=robust", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  EXPECT_EQ(advice("run -f pinned2 --resolution 8x8 --frames 1"), 0);
  EXPECT_EQ(advice("run -f selfCollision --resolution 20x20 --frames 40"), 1);
}

TEST(Program, TakesNoNumberOfThreadsThatIsNone) {
  for (const char* threads : {"0", "257", "two", ""}) {
    const CommandResult result = clothsim("run -f pinned2 --resolution 8x8 --frames 1 --backend cpu",
                                          "CLOTHSIM_THREADS='" + std::string(threads) + "'");
    EXPECT_EQ(result.exitCode, 2) << threads;
    EXPECT_NE(result.output.find("CLOTHSIM_THREADS is \"" + std::string(threads) + "\""), std::string::npos)
        << result.output;
  }
}

TEST(Program, TakesAsManyThreadsAsItIsTold) {
  const std::string run = "run -f pinned2 --resolution 8x8 --frames 1 --backend cpu --json --threads ";
  for (const char* threads : {"2", "3"})
    EXPECT_EQ(jsonOf(run + threads, "CLOTHSIM_THREADS=5")["device"],
              "CPU, " + std::string(threads) + " threads");
  for (const char* threads : {"0", "257", "two"}) {
    const CommandResult result = clothsim(run + threads);
    EXPECT_EQ(result.exitCode, 2) << threads;
    EXPECT_NE(result.output.find("--threads: expected a whole number from 1 to 256, found \"" +
                                 std::string(threads) + "\""),
              std::string::npos)
        << result.output;
  }
}

TEST(Program, GivesOneHashOnBothBackendsAtAnyNumberOfThreads) {
  const std::string run =
      "run -f pinned2 --resolution 50x50 --frames 5 --json --set solver.self_collision=false";
  const std::string expected = jsonOf(run + " --backend cpu")["state_hash"];
  for (const char* threads : {"1", "2", "7"}) {
    EXPECT_EQ(jsonOf(run + " --backend cpu", std::string("CLOTHSIM_THREADS=") + threads)["state_hash"],
              expected)
        << threads;
    EXPECT_EQ(jsonOf(run + " --backend gpu", std::string("LP_NUM_THREADS=") + threads)["state_hash"],
              expected)
        << threads;
  }
}

TEST(Program, GivesOneHashWithAnyVectors) {
  for (const char* scene :
       {"pinned2 --resolution 40x40", "selfCollision --resolution 30x30 --set solver.self_collision=robust",
        "sphere --resolution 21x21 --set solver.integrator=implicit --set cloth.material=silk"}) {
    std::set<std::string> hashes;
    for (const VectorSet set : vectorSetsHere())
      hashes.insert(jsonOf("run --frames 12 --json --backend cpu -f " + std::string(scene),
                           "CLOTHSIM_VECTORS=" + std::string(nameOf(set)))["state_hash"]);
    EXPECT_EQ(hashes.size(), 1) << scene;
  }
}

TEST(Program, SaysWhichVectorsThereAre) {
  const CommandResult result =
      clothsim("run -f pinned2 --resolution 8x8 --frames 1 --backend cpu", "CLOTHSIM_VECTORS=wide");
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_NE(result.output.find("CLOTHSIM_VECTORS is \"wide\"; set it to plain"), std::string::npos)
      << result.output;
}

TEST(Program, ComparesTheBackendsAndSaysSoInItsExitCode) {
  const json compare = jsonOf("compare -f sphere --resolution 24x24 --frames 4 --json");
  EXPECT_TRUE(compare["bitwise_equal"].get<bool>());
  EXPECT_EQ(compare["differing_floats"], 0);
  EXPECT_EQ(compare["floats"], 6 * 24 * 24);
  EXPECT_EQ(compare["frames"], 4);
  EXPECT_TRUE(compare["first_differing_step"].is_null());
  EXPECT_EQ(compare["integrator"], "verlet");
}

// What the viewer's hands did, done again without a window.
constexpr const char* RECORDING = R"({
  "schema": "clothsim-recording/1", "backend": "cpu", "frames": 5,
  "scene": {"cloth": {"num_width_points": 12, "num_height_points": 12, "pinned": ["top"]},
            "solver": {"simulation_steps": 10}},
  "events": [
    {"step": 0, "action": "grab", "particle": 140, "target": [0.5, 0.8, 0.9], "strength": 1e5, "radius": 0.2},
    {"step": 20, "action": "cut", "cloth": 0, "from": [-1, 3.5], "to": [6.2, 3.5]},
    {"step": 20, "action": "switch_backend", "backend": "gpu"},
    {"step": 30, "action": "set_pin", "particle": 100, "pinned": true},
    {"step": 30, "action": "release"}
  ]})";

TEST(Program, ReplaysARecordingToOneHashOnBothBackends) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "r.json", RECORDING);
  const std::string replay = "run --replay " + (folder / "r.json").string() + " --json";
  const json cpu = jsonOf(replay + " --backend cpu"), gpu = jsonOf(replay + " --backend gpu");
  EXPECT_EQ(cpu["backend"], "cpu");
  EXPECT_EQ(gpu["backend"], "gpu");
  EXPECT_EQ(cpu["state_hash"], gpu["state_hash"]);
  EXPECT_EQ(jsonOf(replay)["state_hash"], gpu["state_hash"]) << "switching as it was recorded";
  EXPECT_EQ(cpu["frames"], 5);
  EXPECT_EQ(cpu["steps"], 50);
  EXPECT_LT(cpu["triangles"], 2 * 11 * 11);
  EXPECT_LT(cpu["springs"], 2 * 11 * 12 + 2 * 11 * 11 + 2 * 10 * 12);
  EXPECT_TRUE(cpu["contact_sound"].is_null()) << "the cloth is cut";
  const json longer = jsonOf(replay + " --backend cpu --frames 7 --save " + (folder / "a.state").string());
  EXPECT_EQ(longer["frames"], 7);
  EXPECT_NE(longer["state_hash"], cpu["state_hash"]);
}

TEST(Program, TakesEitherASceneOrARecording) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "r.json", RECORDING);
  const std::string replay = "run --replay " + (folder / "r.json").string();
  for (const char* other : {" -f pinned2", " --resolution 9x9", " --set gravity=[0,0,0]", " --from a.state"})
    EXPECT_EQ(clothsim(replay + other).exitCode, 2) << other;
  const CommandResult missing = clothsim("run --replay nowhere.json");
  EXPECT_EQ(missing.exitCode, 3);
  EXPECT_NE(missing.output.find("nowhere.json"), std::string::npos) << missing.output;
  writeFileAtomically(folder / "wrong.json",
                      std::string(RECORDING).replace(std::string(RECORDING).find("\"particle\": 140"), 15,
                                                     "\"particle\": 999"));
  const CommandResult wrong = clothsim("run --backend cpu --replay " + (folder / "wrong.json").string());
  EXPECT_EQ(wrong.exitCode, 3);
  EXPECT_NE(wrong.output.find("wrong.json: events.0: grab: there is no particle 999, expected 0 to 143"),
            std::string::npos)
      << wrong.output;
}

TEST(Program, RefusesWhatIsNoPlainNumber) {
  const auto refuses = [](const std::string& command) {
    const CommandResult result = clothsim(command);
    EXPECT_EQ(result.exitCode, 2) << command << "\n" << result.output;
  };
  const std::string run = "run -f pinned2 --frames 1 ", render = "render -f pinned2 --frames 1 --out a.mp4 ";
  for (const std::string& command :
       {run + "--seed ", render + "--fps ", render + "--view 0,", std::string("bench --seconds "),
        std::string("bench --after "), std::string("-f pinned2 --restart ")})
    refuses(command + "nan");
  for (const std::string number : {"nan", "inf", "0x1", "''", "1e999", "' 1'", "'1;5'"}) {
    refuses("run -f pinned2 --frames " + number);
    refuses(run + "--jitter " + number);
  }
  EXPECT_EQ(jsonOf("run -f pinned2 --resolution 4x4 --backend cpu --json --frames 010")["frames"], 10);
}

TEST(Program, CountsParticlesThatStartInsideACollider) {
  const std::string run = "run --frames 0 --backend cpu --json -f sphere";
  EXPECT_EQ(jsonOf(run)["start_overlaps"]["colliders"], 0);
  // A ball of 0.2 m around the middle of the sheet of 50 x 50 points: as many as lattice points lie within
  // it.
  int inside = 0;
  for (int row = 0; row < 50; ++row)
    for (int column = 0; column < 50; ++column)
      inside += std::hypot(column / 49.0 - 0.5, row / 49.0 - 0.5) < 0.2 ? 1 : 0;
  const std::string moved = run + " --set 'sphere.origin=[0.5,1,0.5]' --set sphere.radius=0.2";
  EXPECT_EQ(jsonOf(moved)["start_overlaps"]["colliders"], inside);
  EXPECT_NE(clothsim(moved).output.find(std::to_string(inside) + " particles start inside a collider"),
            std::string::npos);
}

TEST(Program, CountsCrossingsWhenAskedOrSaysWhatIsMissing) {
  const std::string run =
      "run -f selfCollision --resolution 20x20 --set solver.self_collision=false --backend cpu ";
  if (!CrossingCounter::available()) {
    const CommandResult result = clothsim(run + "--frames 1 --check-crossings");
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.output.find("libcgal-dev"), std::string::npos) << result.output;
    return;
  }
  const json crossings = jsonOf(run + "--frames 60 --check-crossings --json")["crossings"];
  EXPECT_EQ(crossings["frames_checked"], 61);
  EXPECT_GT(crossings["worst"], 0) << "a sheet that collapses without self-collision";
  EXPECT_GE(crossings["total"], crossings["worst"]);
  EXPECT_GT(crossings["first_frame"], 0);
  EXPECT_TRUE(crossings["neighbours"].is_number());
  EXPECT_FALSE(jsonOf(run + "--frames 1 --json").contains("crossings"));
  const json compared = jsonOf("compare -f pinned2 --resolution 12x12 --frames 2 --check-crossings --json");
  EXPECT_EQ(compared["crossings"]["frames_checked"], 3);
  EXPECT_EQ(compared["crossings"]["worst"], 0);
  EXPECT_TRUE(compared["crossings"]["first_frame"].is_null());
}

TEST(Program, AnswersWrongUsageWithTwo) {
  for (const char* arguments :
       {"run", "run -f pinned2", "run -f pinned2 --frames many", "run -f pinned2 --frames -3", "fly",
        "run -f pinned2 --frames 1 --backend abacus", "run -f pinned2 --frames 1 --resolution big",
        "run -f pinned2 --frames 1 --save cloth.docx", "run -f pinned2 --frames 1 --save cloth_%04d.pc2",
        "render -f pinned2 --frames 1 --out clip.gif", "render -f pinned2 --frames 1 --out a.png --size 0x0",
        "describe cloth.dampin", "run -f pinned2 --frames 1 --seed 2",
        "run -f pinned2 --frames 4 --every 2 --save a.obj",
        "render -f pinned2 --frames 4 --every 2 --out a.png",
        "run -f pinned2 --frames 4 --first-frame 2 --save a.pc2",
        "render -f pinned2 --frames 4 --first-frame 2 --out a.png"})
    EXPECT_EQ(clothsim(arguments).exitCode, 2) << arguments;
}

TEST(Program, NamesTheWordThatItDoesNotKnowOrTakesOnlyOnce) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"run -f pinned2 --frame 3", "run: there is no option --frame; did you mean \"--frames\"?"},
      {"render -f pinned2 --outt a.png --frames 2", "did you mean \"--out\"?"},
      {"rnu -f pinned2 --frames 2", "there is no command \"rnu\"; did you mean \"run\"?"},
      {"-f pinned2 run --frames 2", "write it behind: clothsim run -f ..."},
      {"run --set solver.cg_iterations=1 -q --frames -1", "run: there is no option -q"},
      {"run -f pinned2 --frames 1 --trace a.csv --trace b.csv", "--trace: expected once, found more often"},
      {"run --frames -1 -f pinned2", "--frames"}};
  for (const auto& [arguments, part] : cases) {
    const CommandResult result = clothsim(arguments);
    EXPECT_EQ(result.exitCode, 2) << arguments;
    EXPECT_NE(result.output.find(part), std::string::npos) << arguments << "\n" << result.output;
  }
}

TEST(Program, NamesTheOptionWhoseValueIsEmpty) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"-f ''", "--scene"},
      {"run -f '' --frames 1", "--scene"},
      {"run -f pinned2 --frames 1 --from ''", "--from"},
      {"run --replay ''", "--replay"},
      {"run --replay '' -f pinned2 --frames 1", "--replay"},
      {"run -f pinned2 --frames 1 --trace ''", "--trace"},
      {"run -f pinned2 --frames 1 --save ''", "--save"},
      {"run -f pinned2 --frames 1 --save a.obj --save ''", "--save"},
      {"run -f pinned2 --frames 1 --backend ''", "--backend"},
      {"render -f pinned2 --frames 1 --out ''", "--out"},
      {"render -f pinned2 --frames 1 --out a.png --from ''", "--from"},
      {"sweep -f pinned2 --vary cloth.ks=5 --out ''", "--out"},
      {"describe ''", "key"}};
  for (const auto& [arguments, option] : cases) {
    const CommandResult result = clothsim(arguments);
    EXPECT_EQ(result.exitCode, 2) << arguments;
    EXPECT_NE(result.output.find(option + ": "), std::string::npos) << arguments << "\n" << result.output;
  }
}

TEST(Program, AnswersAWrongSceneWithThreeAndTheNearestName) {
  const CommandResult result = clothsim("run -f pined2 --frames 1");
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.output.find("pinned2"), std::string::npos) << result.output;
  EXPECT_EQ(clothsim("run -f ./nowhere.json --frames 1").exitCode, 3);
  EXPECT_EQ(clothsim("run -f pinned2 --frames 1 --set cloth.dampin=1").exitCode, 3);
}

TEST(Program, AnswersAPlaceItCannotWriteToWithFive) {
  EXPECT_EQ(
      clothsim("run -f pinned2 --frames 1 --resolution 8x8 --backend cpu --save /nonexistent/a.csv").exitCode,
      5);
  EXPECT_EQ(clothsim("run -f pinned2 --frames 1 --resolution 8x8 --backend cpu --from /nonexistent/a.state")
                .exitCode,
            5);
}

TEST(Backend, IsTheFasterOneUnlessGivenAndThatIsSaid) {
  const std::string run = "run -f pinned2 --resolution 10x10 --frames 1";
  const bool software = testContext().software;
  EXPECT_EQ(jsonOf(run + " --json 2>/dev/null")["backend"], software ? "cpu" : "gpu");
  EXPECT_EQ(clothsim(run).output.find("simulating on the CPU") != std::string::npos, software);
}

class NoOpenGl : public testing::TestWithParam<const char*> {};

TEST_P(NoOpenGl, IsAnsweredWithFourAndWhatWasFoundAndNeeded) {
  for (const char* command : {"run -f pinned2 --frames 1 --backend gpu", "compare -f pinned2 --frames 1",
                              "doctor", "render -f pinned2 --frames 1 --out /tmp/never.png"}) {
    const CommandResult result = clothsim(command, GetParam());
    EXPECT_EQ(result.exitCode, 4) << command << "\n" << result.output;
    EXPECT_NE(result.output.find("4.5"), std::string::npos) << "what is needed: " << result.output;
    EXPECT_NE(result.output.find("--backend cpu"), std::string::npos) << "what to do: " << result.output;
  }
}

TEST_P(NoOpenGl, DoesNotKeepTheCpuBackendFromRunning) {
  const std::string run = "run -f pinned2 --resolution 10x10 --frames 2";
  EXPECT_EQ(clothsim(run + " --backend cpu", GetParam()).exitCode, 0);
  const CommandResult chosen = clothsim(run, GetParam());
  EXPECT_EQ(chosen.exitCode, 0) << chosen.output;
  EXPECT_NE(chosen.output.find("simulating on the CPU, since there is no usable OpenGL"), std::string::npos)
      << chosen.output;
}

INSTANTIATE_TEST_SUITE_P(All, NoOpenGl,
                         testing::Values("MESA_GL_VERSION_OVERRIDE=4.2", "LIBGL_DRIVERS_PATH=/nonexistent",
                                         "GALLIUM_DRIVER=softpipe"),
                         [](const auto& instance) {
                           const std::string text = instance.param;
                           std::string name;
                           for (const char c : text.substr(0, text.find('=')))
                             if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
                           return name;
                         });

TEST(Program, WithoutADisplayNamesTheCommandsThatNeedNone) {
  const CommandResult result = clothsim("-f pinned2");
  EXPECT_EQ(result.exitCode, 4);
  EXPECT_NE(result.output.find("clothsim render"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("clothsim run"), std::string::npos) << result.output;
}

TEST(Program, SavesNumberedStatesAndGoesOnFromOne) {
  const test::TemporaryFolder folder;
  const std::string at = folder.path().string();
  const std::string scene = "-f pinned2 --resolution 12x12 --backend cpu";
  ASSERT_EQ(clothsim("run " + scene + " --frames 6 --every 3 --save " + at + "/s%04d.state --save " + at +
                     "/last.csv --save " + at + "/all.pc2")
                .exitCode,
            0);
  for (const char* name : {"s0000.state", "s0003.state", "s0006.state", "last.csv", "all_rest.obj"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  const std::string whole = jsonOf("run " + scene + " --frames 6 --json")["state_hash"];
  EXPECT_EQ(jsonOf("run " + scene + " --frames 3 --from " + at + "/s0003.state --json")["state_hash"], whole);
  const std::string csv = readFile(folder.path() / "last.csv");
  EXPECT_TRUE(csv.starts_with("index,x,y,z,vx,vy,vz\n"));
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "all.pc2"), 32 + 3 * 144 * 12u) << "frames 0, 3 and 6";
}

TEST(Program, RendersAStillAndNumberedPictures) {
  const test::TemporaryFolder folder;
  const std::string at = folder.path().string();
  const CommandResult result = clothsim("render -f sphere --resolution 16x16 --frames 4 --size 96x64 --out " +
                                        at + "/still.png --every 2 --out " + at + "/f%02d.png");
  ASSERT_EQ(result.exitCode, 0) << result.output;
  for (const char* name : {"still.png", "f00.png", "f02.png", "f04.png"})
    EXPECT_EQ(readFile(folder.path() / name).substr(1, 3), "PNG") << name;
}

TEST(Program, SavesThePicturesOfARunThatRenderMakes) {
  const test::TemporaryFolder folder;
  const std::string at = folder.path().string() + "/",
                    scene = " -f pinned2 --resolution 12x12 --backend cpu --frames 4 --every 2";
  ASSERT_EQ(clothsim("run" + scene + " --save " + at + "still.png --save " + at + "f%02d.png").exitCode, 0);
  ASSERT_EQ(clothsim("render" + scene + " --out " + at + "rendered.png --out " + at + "r%02d.png").exitCode,
            0);
  const std::string still = readFile(folder / "still.png");
  EXPECT_EQ(still, readFile(folder / "rendered.png"));
  EXPECT_EQ(still, readFile(folder / "f04.png"));
  EXPECT_NE(still, readFile(folder / "f00.png"));
  EXPECT_EQ(folder.fileCount(), 8) << "and f02.png, and as many of render";
  const CommandResult wrong = clothsim("run -f pinned2 --frames 1 --save " + at + "still.gif");
  EXPECT_EQ(wrong.exitCode, 2);
  EXPECT_NE(wrong.output.find(".png, .mp4"), std::string::npos) << wrong.output;
}

TEST(Program, DrawsTheCutsOfARecording) {
  const test::TemporaryFolder folder;
  const std::string whole =
      std::regex_replace(std::string(RECORDING), std::regex("[^\n]*\"cut\"[^\n]*\n"), "");
  writeFileAtomically(folder / "cut.json", RECORDING);
  writeFileAtomically(folder / "whole.json", whole);
  for (const std::string name : {"cut", "whole"}) {
    const std::string at = (folder / name).string();
    const CommandResult run = clothsim("run --backend cpu --replay " + at + ".json --save " + at +
                                       "%d.png --save " + at + ".pc2 --every 5");
    ASSERT_EQ(run.exitCode, 0) << run.output;
    EXPECT_EQ(run.output.find("keeps the triangles of the start") != std::string::npos, name == "cut")
        << run.output;
  }
  EXPECT_EQ(readFile(folder / "cut0.png"), readFile(folder / "whole0.png"));
  EXPECT_NE(readFile(folder / "cut5.png"), readFile(folder / "whole5.png"));
}

TEST(Program, RefusesNumbersOfFramesThatItDoesNotUnderstand) {
  for (const char* command : {"run -f pinned2 --frames 1 --save ", "render -f pinned2 --frames 1 --out "}) {
    const CommandResult odd = clothsim(std::string(command) + "x_%4d.png"),
                        film = clothsim(std::string(command) + "x_%04d.mp4");
    EXPECT_EQ(odd.exitCode, 2) << odd.output;
    EXPECT_NE(odd.output.find("found %4d; write x_%04d.png"), std::string::npos) << odd.output;
    EXPECT_EQ(film.exitCode, 2) << film.output;
    EXPECT_NE(film.output.find("holds all frames"), std::string::npos) << film.output;
  }
}

TEST(Program, RendersAFilmOrSaysThatFfmpegIsMissing) {
  const test::TemporaryFolder folder;
  const std::string film = (folder.path() / "clip.mp4").string();
  const std::string render = "render -f pinned2 --resolution 16x16 --frames 12 --size 96x64 --out " + film;
  ASSERT_EQ(clothsim(render).exitCode, 0);
  EXPECT_EQ(readFile(film).substr(4, 4), "ftyp");
  const CommandResult without = clothsim(render, "PATH=/nonexistent");
  EXPECT_EQ(without.exitCode, 5) << without.output;
  EXPECT_NE(without.output.find("ffmpeg"), std::string::npos) << without.output;
}

TEST(Program, ListsItsScenesAndExplainsItsKeys) {
  const CommandResult scenes = clothsim("scenes");
  EXPECT_EQ(scenes.exitCode, 0);
  EXPECT_NE(scenes.output.find("selfCollision"), std::string::npos);
  EXPECT_NE(clothsim("describe cloths.0.ks").output.find("cloth.ks"), std::string::npos)
      << "as messages write it";
  const CommandResult key = clothsim("describe cloth.ks");
  EXPECT_EQ(key.exitCode, 0);
  EXPECT_NE(key.output.find("N/m"), std::string::npos) << key.output;
  EXPECT_EQ(clothsim("describe").exitCode, 0);
  const std::string sphere = clothsim("describe sphere").output;
  EXPECT_NE(sphere.find("sphere.radius\n"), std::string::npos) << sphere;
  EXPECT_EQ(sphere.find("normal"), std::string::npos) << "a key of planes: " << sphere;
  EXPECT_NE(clothsim("describe capsule.radius").output.find("capsule.radius\n"), std::string::npos);
}

TEST(Program, MeasuresImplicitStepsWithoutContactAndWithIt) {
  const json bench = jsonOf(
      "bench -f pinned2 --set cloth.material=cotton --resolution 12x12 --backend cpu --seconds 0.02 --json");
  ASSERT_EQ(bench["steps"].size(), 2u);
  EXPECT_EQ(bench["steps"][0]["self_collision"], "off");
  EXPECT_EQ(bench["steps"][1]["self_collision"], "contact");
  EXPECT_TRUE(bench["steps"][1]["pass_ms"].contains("find touching")) << bench["steps"][1]["pass_ms"];
  EXPECT_FALSE(bench["steps"][0]["pass_ms"].contains("find touching"));
}

TEST(Program, MeasuresStepsAndPassesAndTheDemoInRealTime) {
  const json bench = jsonOf("bench --resolution 32x32 --seconds 0.05 --json");
  ASSERT_EQ(bench["steps"].size(), 8u) << "two backends: springs, limiter, two self-collisions";
  for (const json& step : bench["steps"]) {
    EXPECT_GT(step["particle_steps_per_second"].get<double>(), 0);
    if (step["backend"] == "gpu") {
      EXPECT_GT(step["pass_ms"].size(), 0u);
      EXPECT_GE(step["dispatches_per_step"], step["pass_ms"].size());
    } else {
      EXPECT_GT(step["bytes_per_particle"], 13 * sizeof(float))
          << "two states and the inverse masses, at least";
      EXPECT_GT(step["share_of_roof"]["memory"].get<double>(), 0);
      EXPECT_GT(step["share_of_roof"]["arithmetic"].get<double>(), 0);
    }
  }
  EXPECT_EQ(bench["demo_real_time"].size(), 6u) << "two backends, three ways of drawing";
}

TEST(Program, ResolvesTheSameClothAtAnotherResolutionWithMoreSteps) {
  const json run = jsonOf("run -f pinned2 --resolution 99x99 --frames 1 --backend cpu --json");
  EXPECT_EQ(run["steps"], 60) << "half the spacing: twice the steps";
  EXPECT_EQ(jsonOf("run -f pinned2 --resolution 99x99 --frames 1 --backend cpu --set "
                   "solver.simulation_steps=45 --json")["steps"],
            45);
}

}  // namespace
}  // namespace clothsim
