// How the scripts of tools/ take their arguments.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/files.h"
#include "support/command.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

TEST(Tools, TakeTheProgramAndFilesFromWhereTheyAreCalled) {
  const test::TemporaryFolder folder;
  std::filesystem::create_symlink(CLOTHSIM_PROGRAM, folder / "here");
  const test::CommandResult result = test::runCommand(
      "cd " + folder.path().string() +
      " && CLOTHSIM=./here " SOURCE_ROOT "/tools/compare_scenes pinned4 --frames 1 --out table.csv 2>&1");
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_NE(readFile(folder / "table.csv").find("clothsim compare -f pinned4 --frames 1"), std::string::npos);
}

TEST(Tools, RefuseArgumentsThatTheyDoNotKnow) {
  for (const std::string name : {"make_garment", "make_meshes", "make_body", "fuzz"}) {
    const std::string tool = SOURCE_ROOT "/tools/" + name;
    EXPECT_EQ(test::runCommand(tool + " --help").exitCode, 0) << name;
    const test::CommandResult refused = test::runCommand(tool + " --out 2>&1");
    EXPECT_EQ(refused.exitCode, 2) << name;
    EXPECT_NE(refused.output.find("tools/" + name), std::string::npos) << refused.output;
  }
}

}  // namespace
}  // namespace clothsim
