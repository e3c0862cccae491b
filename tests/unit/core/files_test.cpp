#include "core/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <functional>

#include "core/error.h"
#include "core/printable.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputOutputError& error) {
    return error.what();
  }
  return "no InputOutputError";
}

std::string messageOfReading(const fs::path& path) {
  return messageOf([&] { (void)readFile(path); });
}

std::size_t filesIn(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WriteFileAtomically, WritesWhatReadFileReads) {
  const test::TemporaryFolder folder;
  std::string bytes("zero \0 byte, newline \r\n, high \xff", 31);
  writeFileAtomically(folder / "a.bin", bytes);
  EXPECT_EQ(readFile(folder / "a.bin"), bytes);
  writeFileAtomically(folder / "a.bin", "");
  EXPECT_EQ(readFile(folder / "a.bin"), "");
  EXPECT_EQ(filesIn(folder.path()), 1U);
}

TEST(WriteFileAtomically, LeavesNoHalfFileBehindAFailure) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "taken");
  EXPECT_NE(messageOf([&] { writeFileAtomically(folder / "taken", "x"); }).find("is a folder"),
            std::string::npos);
  const std::string message = messageOf([&] { writeFileAtomically(folder / "missing" / "a.txt", "x"); });
  EXPECT_NE(message.find("missing/a.txt: cannot be written: No such file or directory"), std::string::npos)
      << message;
  EXPECT_EQ(filesIn(folder.path()), 1U);
}

TEST(CheckWritable, RefusesBeforeTheWorkWhatCouldNotBeWrittenAfterIt) {
  const test::TemporaryFolder folder;
  EXPECT_NO_THROW(checkWritable(folder / "new.png"));
  EXPECT_NO_THROW(checkWritable("new.png"));
  EXPECT_NE(messageOf([&] { checkWritable(folder.path()); }).find("cannot be written"), std::string::npos);
  EXPECT_NE(messageOf([&] { checkWritable(folder / "missing" / "a.png"); }).find("No such file"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "new.png")) << "asking writes nothing";
}

// Works for root, too, who may write to any folder.
TEST(CheckWritable, RefusesNamesThatNoFileCanHave) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "file", "");
  fs::create_symlink("circle.csv", folder / "circle.csv");
  fs::create_symlink("missing/a.csv", folder / "nowhere.csv");
  const std::pair<fs::path, const char*> cases[] = {
      {folder / (std::string(260, 'x') + ".csv"), "File name too long"},
      {folder / "circle.csv", "Too many levels of symbolic links"},
      {folder / "nowhere.csv", "No such file or directory"},
      {folder / "file" / "a.csv", "Not a directory"},
      {folder.path() / std::string(5000, 'x'), "File name too long"}};
  for (const auto& refused : cases) {
    const fs::path& path = refused.first;
    const std::string expected = printable(path.string() + ": cannot be written: " + refused.second);
    EXPECT_EQ(messageOf([&] { checkWritable(path); }), expected);
    EXPECT_EQ(messageOf([&] { writeFileAtomically(path, "x"); }), expected);
  }
  EXPECT_EQ(filesIn(folder.path()), 3U);
}

// As two programs in two containers can have: one process number, one counter of files.
TEST(GrowingFile, TakesNoNameThatAnotherProgramMayHaveTakenOrForeseen) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "dear", "to somebody");
  for (int i = 0; i < 3000; ++i)
    fs::create_symlink(
        "dear", folder / (".clothsim-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".txt"));
  writeFileAtomically(folder / "a.txt", "mine");
  EXPECT_EQ(readFile(folder / "dear"), "to somebody");
  EXPECT_EQ(readFile(folder / "a.txt"), "mine");
  EXPECT_FALSE(fs::is_symlink(folder / "a.txt"));
}

TEST(GrowingFile, LetsTwoWriteOneFileAtATimeAndTheLastOneWins) {
  const test::TemporaryFolder folder;
  GrowingFile a(folder / "a"), b(folder / "a");
  EXPECT_EQ(filesIn(folder.path()), 2U);
  const std::string large(1 << 17, 'a');
  a.append(large);
  b.append("b");
  a.append("!");
  b.close();
  EXPECT_EQ(readFile(folder / "a"), "b");
  a.overwrite(1, "A");
  a.append("!");
  a.close();
  EXPECT_EQ(readFile(folder / "a"), "aA" + large.substr(2) + "!!");
  EXPECT_EQ(filesIn(folder.path()), 1U);
}

TEST(WriteFileAtomically, ReportsAFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const std::string message = messageOf([] { writeFileAtomically("/dev/full", "x"); });
  EXPECT_EQ(message, "/dev/full: cannot be written: No space left on device");
}

TEST(WriteFileAtomically, KeepsDevicesLinksAndPermissions) {
  const test::TemporaryFolder folder;
  writeFileAtomically("/dev/null", "x");
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));

  writeFileAtomically(folder / "target.txt", "old");
  fs::permissions(folder / "target.txt", fs::perms(0600));
  fs::create_symlink("target.txt", folder / "link.txt");
  writeFileAtomically(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(readFile(folder / "target.txt"), "new");
  EXPECT_EQ(fs::status(folder / "target.txt").permissions(), fs::perms(0600));

  fs::create_directory(folder / "deep");
  fs::create_symlink("deep/new.txt", folder / "to_come.txt");
  writeFileAtomically(folder / "to_come.txt", "made");
  EXPECT_EQ(readFile(folder / "deep" / "new.txt"), "made");
}

TEST(ReadFile, SaysWhyAFileCannotBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(messageOfReading(folder / "none"),
            (folder / "none").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(messageOfReading(folder.path()), folder.path().string() + ": is a folder, not a file");
}

TEST(ReadFile, DoesNotWaitForAPipe) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(messageOfReading(folder / "pipe"), (folder / "pipe").string() + ": is not a regular file");
}

TEST(ReadFile, RefusesFilesBeyondTheLimit) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "big", "12345678");
  EXPECT_EQ(readFile(folder / "big", 8).size(), 8U);
  const std::string message = messageOf([&] { (void)readFile(folder / "big", 7); });
  EXPECT_NE(message.find("has 8 bytes, more than the limit of 7"), std::string::npos);
}

TEST(NumberedName, FillsInTheFrame) {
  EXPECT_EQ(numberedName("frame_%04d.png", 7), "frame_0007.png");
  EXPECT_EQ(numberedName("frame_%04d.png", 123456), "frame_123456.png");
  EXPECT_EQ(numberedName("%d.obj", 12), "12.obj");
  EXPECT_EQ(numberedName("100%/f%02d", 3), "100%/f03");
  EXPECT_EQ(numberedName("still.png", 7), "still.png");
}

TEST(HasFrameNumber, KnowsOnlyDecimalNumbers) {
  EXPECT_TRUE(hasFrameNumber("frame_%04d.png"));
  EXPECT_TRUE(hasFrameNumber("%d"));
  EXPECT_FALSE(hasFrameNumber("still.png"));
  EXPECT_FALSE(hasFrameNumber("%s.png"));
  EXPECT_FALSE(hasFrameNumber("%4d.png"));
  EXPECT_FALSE(hasFrameNumber("%0d.png"));
  EXPECT_FALSE(hasFrameNumber("%099999999999d.png"));
  EXPECT_FALSE(hasFrameNumber("100%"));
}

TEST(FindResourceRoot, LooksAtTheEnvironmentThenAboveTheProgramThenInTheSources) {
  const test::TemporaryFolder folder;
  const fs::path chosen = folder / "chosen", sources = folder / "sources", prefix = folder / "prefix";
  for (const fs::path& root : {chosen, sources, prefix / "share" / "clothsim"})
    fs::create_directories(root / "assets" / "scenes");
  fs::create_directories(prefix / "bin");

  EXPECT_EQ(findResourceRoot(chosen.c_str(), prefix / "bin", sources), chosen);
  EXPECT_EQ(findResourceRoot(nullptr, prefix / "bin", sources), prefix / "share" / "clothsim");
  EXPECT_EQ(findResourceRoot("", sources / "build" / "deep", prefix), sources);
  EXPECT_EQ(findResourceRoot(nullptr, folder / "elsewhere", sources), sources);
}

TEST(FindResourceRoot, SaysWhereItLooked) {
  const test::TemporaryFolder folder;
  const std::string wrong =
      messageOf([&] { (void)findResourceRoot(folder.path().c_str(), "/nowhere", "/"); });
  EXPECT_NE(wrong.find("CLOTHSIM_ROOT is " + folder.path().string()), std::string::npos) << wrong;
  const std::string none = messageOf([&] { (void)findResourceRoot(nullptr, "/nowhere/bin", "/no/sources"); });
  EXPECT_NE(none.find("/nowhere/bin"), std::string::npos) << none;
  EXPECT_NE(none.find("/no/sources"), std::string::npos) << none;
}

TEST(ResourceRoot, HoldsTheBundledScenes) {
  EXPECT_TRUE(fs::exists(resourceRoot() / "assets" / "scenes" / "pinned2.json"));
}

}  // namespace
}  // namespace clothsim
