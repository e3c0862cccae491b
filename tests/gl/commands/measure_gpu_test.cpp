// tools/measure_gpu and the command under it, on a software renderer.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/files.h"
#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"
#include "support/command.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

using nlohmann::json;

test::CommandResult measureGpu(const std::string& arguments) {
  return test::runCommand("CLOTHSIM='" CLOTHSIM_PROGRAM "' " SOURCE_ROOT "/tools/measure_gpu " + arguments +
                          " 2>&1");
}

TEST(MeasureGpu, StopsAtOnceOnASoftwareRenderer) {
  if (!testContext().software) GTEST_SKIP() << "there is a GPU here: it would be measured for minutes";
  const test::TemporaryFolder folder;
  const test::CommandResult result = measureGpu("--out " + folder.path().string());
  EXPECT_EQ(result.exitCode, 4) << result.output;
  EXPECT_NE(result.output.find("--allow-software"), std::string::npos) << result.output;
  EXPECT_EQ(json::parse(readFile(folder / "gpu.json"))["blocks"].size(), 1u);
}

TEST(MeasureGpu, WritesWhatItFindsAsJsonAndAsRowsOfATable) {
  const test::TemporaryFolder folder;
  const std::string out = folder.path().string();
  const test::CommandResult result =
      measureGpu("--allow-software --blocks dispatches,roofs,picture --out " + out);
  EXPECT_EQ(result.exitCode, 0) << result.output;
  const json report = json::parse(readFile(folder / "gpu.json"));
  ASSERT_EQ(report["blocks"].size(), 4u);
  EXPECT_GT(report["blocks"][0]["findings"][0]["limits"]["texture_buffer_texels"], 65535);
  for (const std::size_t block : {1, 2}) {
    EXPECT_GT(report["blocks"][block]["findings"].size(), 10u);
    for (const json& finding : report["blocks"][block]["findings"])
      EXPECT_GT(finding["value"].get<double>(), 0) << finding;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "demo.png"));

  EXPECT_EQ(measureGpu("--table " + out + "/gpu.json --csv " + out + "/gpu.csv").exitCode, 0);
  const std::string table = readFile(folder / "gpu.csv");
  EXPECT_NE(table.find("clothsim probe dispatches --small,no barrier,"), std::string::npos) << table;
}

TEST(MeasureGpu, ReportsWhatHadNoTimeLeft) {
  const test::TemporaryFolder folder;
  const test::CommandResult result =
      measureGpu("--allow-software --blocks steps --seconds 0.5 --out " + folder.path().string());
  EXPECT_EQ(result.exitCode, 3) << result.output;
  EXPECT_NE(result.output.find("steps: ran out of time"), std::string::npos) << result.output;
}

// A driver that computes otherwise, for which a changed shader stands in.
TEST(Probe, NamesThePassInWhichADriverBreaksTheContract) {
  const struct {
    const char *file, *from, *to, *only, *pass;
  } faults[] = {
      {"sim/integrate.glsl", "newX = x.xyz + step.timeStep * newV;",
       "newX = x.xyz + 1.0000002 * step.timeStep * newV;", "scene pinned2", "forces, integrate"},
      {"sim/limit.glsl", "? 0.5 * excess", "? 0.49 * excess", "scene fold", "limit"},
      {"sim/implicit/updated_solution.glsl", "scalars.stepSize * texelFetch(directions",
       "1.0001 * scalars.stepSize * texelFetch(directions", "pinned2, implicit",
       "Newton step 1, iteration 1"},
  };
  for (const auto& fault : faults) {
    const test::ResourceCopy copy;
    ASSERT_TRUE(copy.change(fault.file, fault.from, fault.to)) << fault.file;
    const test::CommandResult result =
        test::runCommand("CLOTHSIM_ROOT='" + copy.root.path().string() +
                         "' '" CLOTHSIM_PROGRAM "' probe contract --small --only '" + fault.only + "'");
    EXPECT_EQ(result.exitCode, 1) << fault.file;
    const json line = json::parse(result.output);
    EXPECT_FALSE(line["equal"].get<bool>());
    EXPECT_EQ(line["first_differing_step"], 1);
    EXPECT_EQ(line["pass"], fault.pass);
  }
}

TEST(Probe, FindsNoDifferenceHere) {
  const test::CommandResult result =
      test::runCommand("'" CLOTHSIM_PROGRAM "' probe contract --small --only cut,");
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 2);
  const test::CommandResult none =
      test::runCommand("'" CLOTHSIM_PROGRAM "' probe contract --small --only nosuch 2>&1");
  EXPECT_EQ(none.exitCode, 2) << none.output;
}

}  // namespace
}  // namespace clothsim
