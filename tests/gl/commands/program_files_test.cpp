// The program among full disks, closed streams, signals and names that nobody would choose.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <regex>
#include <string>
#include <thread>

#include "core/files.h"
#include "support/process.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

using test::clothsim;
using test::CommandResult;
using test::runCommand;

const std::string quickRun = "run -f pinned2 --resolution 8x8 --frames 0 --backend cpu";

TEST(ProgramsOutput, ThatCannotBePrintedEndsWithFiveAndAMessage) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  for (const std::string& arguments :
       {quickRun, quickRun + " --json", std::string("scenes"), std::string("--help"),
        std::string("--version"), std::string("describe")}) {
    const CommandResult full = runCommand("( " CLOTHSIM_PROGRAM " " + arguments + " >/dev/full ) 2>&1");
    EXPECT_EQ(full.exitCode, 5) << arguments;
    EXPECT_NE(full.output.find("the results could not be printed"), std::string::npos) << arguments << "\n"
                                                                                       << full.output;
  }
}

TEST(ProgramsOutput, GoesIntoNoFileThatIsSaved) {
  const test::TemporaryFolder folder;
  const std::string csv = (folder / "a.csv").string();
  ASSERT_EQ(clothsim(quickRun + " --save " + csv).exitCode, 0);
  const std::string whole = readFile(csv);
  EXPECT_EQ(runCommand(CLOTHSIM_PROGRAM " " + quickRun + " --json --save " + csv + " 2>&1 >&-").exitCode, 5);
  EXPECT_EQ(readFile(csv), whole);
  EXPECT_EQ(runCommand(CLOTHSIM_PROGRAM " " + quickRun + " --save " + csv + " <&- >&- 2>&-").exitCode, 5);
  EXPECT_EQ(readFile(csv), whole);
}

TEST(ProgramsOutput, MayHaveAReaderWhoStopsReading) {
  const CommandResult result = runCommand("bash -c 'set -o pipefail; ( " CLOTHSIM_PROGRAM
                                          " describe 2>&1 >&3 3>&- | cat >&2 ) 3>&1 | head -n 1' 2>&1");
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.output, "schema\n");
}

TEST(ProgramsFiles, HaveNamesThatAreAnsweredWhateverTheyAre) {
  const test::TemporaryFolder folder;
  const std::string at = folder.path().string() + "/", longName(300, 'x');
  fs::create_symlink("circle.json", folder / "circle.json");
  writeFileAtomically(folder / "file.json", R"({"cloth": {"mesh": "x"}})");
  writeFileAtomically(folder / "mesh.json", R"({"cloth": {"ks": 1, "mesh": ")" + longName + R"("}})");
  writeFileAtomically(folder / "collider.json",
                      R"({"colliders": [{"type": "mesh", "file": ")" + longName + R"("}]})");
  const std::string cpu = " --frames 0 --backend cpu";
  const std::pair<std::string, int> cases[] = {
      {"run -f " + longName + cpu, 3},
      {"run -f ./" + longName + ".json" + cpu, 3},
      {"run -f " + at + "circle.json" + cpu, 3},
      {"run -f " + at + "file.json/a.json" + cpu, 3},
      {"run -f " + at + "mesh.json" + cpu, 3},
      {"run -f " + at + "collider.json" + cpu, 3},
      {quickRun + " --set cloth.mesh=" + longName, 3},
      {quickRun + " --set render.texture=./" + longName + ".png --save " + at + "a.png", 5},
      {quickRun + " --save " + at + longName + ".csv", 5},
      {quickRun + " --save " + at + std::string(249, 'x') + ".pc2", 5},  // no room for _rest.obj
      {quickRun + " --save " + at + "circle.json/a.csv", 5},
      {quickRun + " --from " + at + longName + ".state", 5},
      {quickRun + " --save " + at + "a.csv --trace " + at + "a.csv", 2},
      {quickRun + " --save " + at + "b.pc2 --save " + at + "b_rest.obj", 2},
      {"run --replay " + at + longName, 3},
      {"sweep -f sphere --frames 1 --vary colliders." + std::string(100'000, '0') +
           ".radius=1 --out /nowhere/a.png",
       5}};
  for (const auto& [arguments, exitCode] : cases) {
    const CommandResult result = clothsim(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << arguments.substr(0, 999) << "\n" << result.output;
    EXPECT_NE(result.output.find("clothsim: "), std::string::npos) << arguments << "\n" << result.output;
  }
  EXPECT_EQ(folder.fileCount(), 4) << "nothing was written";
}

TEST(ProgramsFiles, NeedNotHaveNamesInUtf8) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "\xff.json";
  fs::copy_file(fs::path(SOURCE_ROOT) / "assets/scenes/pinned2.json", scene);
  const CommandResult result = runCommand(CLOTHSIM_PROGRAM " run -f " + scene.string() +
                                          " --resolution 8x8 --frames 0 --backend cpu --json 2>/dev/null");
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_NE(result.output.find("\xef\xbf\xbd.json"), std::string::npos) << result.output;
}

TEST(ProgramsFiles, AreSavedFromAFolderThatIsGone) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "a.json",
                      R"({"cloth": {"ks": 500, "num_width_points": 3, "num_height_points": 3},
                          "render": {"texture": "./print.png"}})");
  const std::string gone = (folder / "gone").string(), csv = (folder / "a.csv").string();
  const CommandResult result = runCommand("mkdir " + gone + " && cd " + gone + " && rmdir " + gone +
                                          " && " CLOTHSIM_PROGRAM " run -f " + (folder / "a.json").string() +
                                          " --frames 1 --backend cpu --save " + csv + " 2>&1");
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_TRUE(fs::exists(csv));
}

TEST(ProgramsFiles, ThatGrowBeyondALimitEndWithFiveAndNoPart) {
  const test::TemporaryFolder folder;
  const CommandResult result = clothsim(
      "run -f pinned2 --resolution 20x20 --frames 10 --backend cpu --save " + (folder / "a.pc2").string(),
      "bash -c 'ulimit -f 16; exec \"$@\"' -");  // 16 KiB
  EXPECT_EQ(result.exitCode, 5) << result.output;
  EXPECT_NE(result.output.find("a.pc2: cannot be written: File too large"), std::string::npos)
      << result.output;
  EXPECT_EQ(folder.fileCount(), 0);
}

TEST(ProgramsMemory, EndsWithAMessage) {
  const CommandResult result =
      clothsim("run -f pinned2 --resolution 4000x4000 --frames 1 --backend cpu",
               "CLOTHSIM_THREADS=1 bash -c 'ulimit -v 400000; exec \"$@\"' -");  // KiB
  EXPECT_EQ(result.exitCode, 1) << result.output;
  EXPECT_NE(result.output.find("not enough memory"), std::string::npos) << result.output;
}

class ProgramsEndBy : public testing::TestWithParam<int> {};

TEST_P(ProgramsEndBy, SignalKeepsTheFramesBefore) {
  const test::TemporaryFolder folder, apart;
  test::Process run({CLOTHSIM_PROGRAM, "run", "-f", "pinned2", "--resolution", "16x16", "--frames",
                     "10000000", "--backend", "cpu", "--json", "--save", (folder / "a.pc2").string(),
                     "--save", (folder / "end.obj").string(), "--trace", (folder / "t.csv").string()},
                    (apart / "said").string());
  ASSERT_TRUE(folder.getsAFile());
  ASSERT_EQ(folder.fileCount(), 1) << "the file grows under a temporary name";
  run.send(GetParam());
  EXPECT_EQ(run.waitFor(std::chrono::seconds(30)), 130);
  EXPECT_EQ(folder.fileCount(), 3) << "a.pc2, a_rest.obj and t.csv";
  const std::string cache = readFile(folder / "a.pc2"), trace = readFile(folder / "t.csv");
  std::int32_t samples = 0;
  std::memcpy(&samples, &cache.at(28), sizeof samples);
  EXPECT_EQ(cache.size(), 32 + static_cast<std::size_t>(samples) * 16 * 16 * 12);
  EXPECT_EQ(std::ranges::count(trace, '\n'), samples + 1) << "a line of names";
  const std::string said = readFile(apart / "said");
  EXPECT_NE(said.find("interrupted after frame " + std::to_string(samples - 1)), std::string::npos) << said;
  for (const std::string& part :
       {"\"frames\": " + std::to_string(samples - 1), std::string("\"interrupted\": true")})
    EXPECT_NE(said.find(part), std::string::npos) << part << " in:\n" << said;
  EXPECT_NE(said.find("Not written, for want of a last frame: " + (folder / "end.obj").string()),
            std::string::npos)
      << said;
}

TEST(ProgramsEnd, DoesNotComeByASignalThatWasIgnoredBefore) {
  const test::TemporaryFolder folder;
  const std::string save = (folder / "a.pc2").string();
  test::Process run({"bash", "-c",
                     "trap '' HUP; exec " CLOTHSIM_PROGRAM
                     " run -f pinned2 --resolution 16x16 --frames 10000000 --backend cpu --save " +
                         save},
                    "/dev/null");
  ASSERT_TRUE(folder.getsAFile());
  ASSERT_EQ(folder.fileCount(), 1);
  run.send(SIGHUP);  // as to nohup
  EXPECT_FALSE(run.waitFor(std::chrono::milliseconds(200)).has_value());
  run.send(SIGTERM);
  EXPECT_EQ(run.waitFor(std::chrono::seconds(30)), 130);
}

INSTANTIATE_TEST_SUITE_P(All, ProgramsEndBy, testing::Values(SIGINT, SIGTERM, SIGHUP, SIGXCPU),
                         [](const auto& instance) {
                           return std::string("Signal") + ::sigabbrev_np(instance.param);
                         });

TEST(InstalledProgram, FindsItsFilesWhereItWasInstalled) {
  const test::TemporaryFolder folder;
  const CommandResult install =
      runCommand("cmake --install '" + fs::path(CLOTHSIM_PROGRAM).parent_path().string() + "' --prefix '" +
                 folder.path().string() + "' 2>&1");
  ASSERT_EQ(install.exitCode, 0) << install.output;
  const fs::path program = folder / "bin" / "clothsim", share = folder / "share" / "clothsim";
  // All that the program reads in its source tree.
  for (const char* part : {"shaders", "assets/scenes", "assets/meshes", "assets/textures"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(SOURCE_ROOT) / part)) {
      if (!entry.is_regular_file()) continue;
      EXPECT_EQ(readFile(share / fs::relative(entry.path(), SOURCE_ROOT)), readFile(entry.path()))
          << entry.path();
    }
  // The source tree has other scenes then.
  for (const fs::directory_entry& scene : fs::directory_iterator(share / "assets" / "scenes"))
    if (scene.path().filename() != "pinned2.json" && scene.path().filename() != "skirt.json")
      fs::remove(scene.path());
  fs::rename(share / "assets/scenes/pinned2.json", share / "assets/scenes/only_here.json");
  const CommandResult scenes = runCommand("cd / && " + program.string() + " scenes 2>&1");
  EXPECT_TRUE(std::regex_match(scenes.output, std::regex("only_here [^\n]*\nskirt [^\n]*\n")))
      << scenes.output;
  EXPECT_EQ(
      runCommand("cd / && " + program.string() + " run -f only_here --frames 1 --backend cpu 2>&1").exitCode,
      0);
  const CommandResult skirt =
      runCommand("cd / && " + program.string() + " run -f skirt --frames 0 --backend cpu 2>&1");
  EXPECT_EQ(skirt.exitCode, 0) << skirt.output;
}

}  // namespace
}  // namespace clothsim
