#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"
#include "support/temporary_folder.h"
#include "support/throws.h"
#include "unit/export/small_cloth.h"

namespace clothsim {
namespace {

using test::messageThrownBy;

class SaveState : public testing::Test {
 protected:
  Cloth cloth_{test::smallScene()};
  State state_ = test::smallState(cloth_);
  test::TemporaryFolder folder_;
};

TEST_F(SaveState, RefusesAnExtensionItDoesNotKnowAndNamesThoseItDoes) {
  const std::string message =
      messageThrownBy<UsageError>([&] { saveState(state_, cloth_, folder_ / "a.fbx"); });
  for (const char* expected : {"a.fbx", "'.fbx'", ".csv", ".ply", ".obj", ".glb", ".npz", ".state"})
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  EXPECT_EQ(folder_.fileCount(), 0);
}

TEST_F(SaveState, TellsBeforehandWhichExtensionsItKnows) {
  for (const char* name : {"a.csv", "a.ply", "a.obj", "a.glb", "a.npz", "b.c/a.state"})
    EXPECT_TRUE(canSaveStateAs(name)) << name;
  for (const char* name : {"a", "a.CSVX", "csv", "a.png", "a.ply.gz"})
    EXPECT_FALSE(canSaveStateAs(name)) << name;
}

TEST_F(SaveState, WritesOneFileAndNothingBesideIt) {
  for (const char* name : {"a.csv", "a.ply", "a.obj", "a.glb", "a.npz", "a.state"})
    saveState(state_, cloth_, folder_ / name);
  EXPECT_EQ(folder_.fileCount(), 6);
}

// A full disk, played by a limit on the size of files.
TEST_F(SaveState, LeavesTheOldFileWhenTheDiskIsFull) {
  const auto path = folder_ / "a.state";
  saveState(state_, cloth_, path);
  const std::string before = readFile(path);
  state_.clock.step = 7;

  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit small{64, old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = messageThrownBy<InputOutputError>([&] { saveState(state_, cloth_, path); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);

  EXPECT_NE(message.find("a.state"), std::string::npos) << message;
  EXPECT_EQ(readFile(path), before);
  EXPECT_EQ(folder_.fileCount(), 1) << "a temporary file was left behind";
}

TEST_F(SaveState, SaysWhichFolderIsMissing) {
  const auto path = folder_ / "missing/a.csv";
  const std::string message = messageThrownBy<InputOutputError>([&] { saveState(state_, cloth_, path); });
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
}

}  // namespace
}  // namespace clothsim
