#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"
#include "support/command.h"
#include "support/temporary_folder.h"
#include "support/throws.h"

namespace clothsim {
namespace {

using test::messageThrownBy;

// What ffprobe, an independent reader, says about the film.
std::string probe(const std::filesystem::path& film) {
  return test::runCommand(
             "ffprobe -v error -count_frames -show_entries "
             "stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames -of csv=p=0 " +
             film.string())
      .output;
}

class VideoWriterTest : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::vector<std::uint8_t> frame_ = std::vector<std::uint8_t>(33 * 17 * 3, 200);
};

TEST_F(VideoWriterTest, MakesAnMp4OfEvenSizeWithEveryFrame) {
  VideoWriter writer(folder_ / "a.mp4", 33, 17, 90);
  for (int i = 0; i < 12; ++i) writer.addFrame(frame_);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4")) << "the film appears only when it is complete";
  writer.close();
  EXPECT_EQ(probe(folder_ / "a.mp4"), "h264,34,18,yuv420p,90/1,12\n");
  EXPECT_EQ(folder_.fileCount(), 1);
}

// (ffprobe does not read animated WebP.)
TEST_F(VideoWriterTest, MakesAWebpOfAnySizeThatRepeats) {
  VideoWriter writer(folder_ / "a.webp", 33, 17, 20);
  for (const int gray : {200, 100, 0}) {
    std::ranges::fill(frame_, static_cast<std::uint8_t>(gray));
    writer.addFrame(frame_);
  }
  writer.close();
  const std::string film = readFile(folder_ / "a.webp");
  EXPECT_EQ(film.substr(0, 4) + film.substr(8, 8), "RIFFWEBPVP8X");
  EXPECT_EQ(film.substr(24, 6), std::string("\x20\0\0\x10\0\0", 6)) << "33 x 17, less one each";
  EXPECT_EQ(film.substr(30, 4), "ANIM");
  EXPECT_EQ(film.substr(42, 2), std::string(2, '\0')) << "it repeats for ever";
  int frames = 0;
  for (std::size_t at = film.find("ANMF"); at != std::string::npos; at = film.find("ANMF", at + 4)) {
    EXPECT_EQ(film.substr(at + 20, 3), std::string("\x32\0\0", 3)) << "50 ms each";
    ++frames;
  }
  EXPECT_EQ(frames, 3);
}

TEST_F(VideoWriterTest, LeavesTheOldFilmWhenItIsAbandoned) {
  writeFileAtomically(folder_ / "a.mp4", "old");
  {
    VideoWriter writer(folder_ / "a.mp4", 33, 17, 30);
    writer.addFrame(frame_);
  }
  EXPECT_EQ(readFile(folder_ / "a.mp4"), "old");
  EXPECT_EQ(folder_.fileCount(), 1) << "a temporary file was left behind";
}

// Whatever a folder is called: ffmpeg must take no name for a protocol or an option.
TEST_F(VideoWriterTest, WritesUnderNamesThatFfmpegWouldReadOtherwise) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  for (const std::filesystem::path path : {"http:/a.mp4", "-f/a.mp4", "pipe:1.mp4", "a%03d.mp4"}) {
    if (path.has_parent_path()) std::filesystem::create_directory(path.parent_path());
    VideoWriter writer(path, 16, 16, 30);
    writer.addFrame(std::vector<std::uint8_t>(16 * 16 * 3, 200));
    writer.close();
    EXPECT_EQ(readFile(path).substr(4, 4), "ftyp") << path;
  }
  std::filesystem::current_path(before);
}

TEST_F(VideoWriterTest, RefusesAPlaceThatCannotBeWrittenToBeforeTheFirstFrame) {
  EXPECT_NE(messageThrownBy<InputOutputError>([&] {
              VideoWriter(folder_ / "missing/a.mp4", 33, 17, 30);
            }).find("missing/a.mp4: cannot be written: No such file or directory"),
            std::string::npos);
  std::filesystem::create_symlink("/dev/null", folder_ / "null.mp4");
  EXPECT_NE(messageThrownBy<InputOutputError>([&] {
              VideoWriter(folder_ / "null.mp4", 33, 17, 30);
            }).find("a film needs a regular file"),
            std::string::npos);
}

// Programs called ffmpeg that stand in for it.
class StandInTest : public VideoWriterTest {
 protected:
  StandInTest() {
    std::filesystem::create_directory(folder_ / "bin");
    ::setenv("PATH", ((folder_ / "bin").string() + ":" + path_).c_str(), 1);
  }
  ~StandInTest() override { ::setenv("PATH", path_.c_str(), 1); }

  void standIn(const std::string& script) {
    writeFileAtomically(folder_ / "bin" / "ffmpeg", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(folder_ / "bin" / "ffmpeg", std::filesystem::perms(0755));
  }

 private:
  std::string path_ = std::getenv("PATH");
};

// More frames than the connection can hold in flight: a writer that did not mind SIGPIPE would end the test
// here.
TEST_F(StandInTest, PassesOnWhatFfmpegSaysWhenItFails) {
  standIn("echo 'no such encoder' >&2; exit 1");
  const std::string message = messageThrownBy<InputOutputError>([&] {
    VideoWriter writer(folder_ / "a.mp4", 33, 17, 30);
    for (int i = 0; i < 5000; ++i) writer.addFrame(frame_);
    writer.close();
  });
  EXPECT_NE(message.find("a.mp4': ffmpeg failed: no such encoder"), std::string::npos) << message;
  EXPECT_EQ(folder_.fileCount(), 1) << "no film, not even a part of one";
}

// What it says before is about every frame.
TEST_F(StandInTest, PassesOnTheEndOfWhatFfmpegSays) {
  standIn("for i in $(seq 500); do echo frame $i is odd >&2; done; echo 'no space left' >&2; exit 1");
  const std::string message =
      messageThrownBy<InputOutputError>([&] { VideoWriter(folder_ / "a.mp4", 33, 17, 30).close(); });
  EXPECT_TRUE(message.ends_with("frame 500 is odd\nno space left")) << message;
}

// Nobody can tell then how a child ended.
TEST_F(StandInTest, DoesNotTakeAFailureForAFilmWhereTheEndOfChildrenIsIgnored) {
  standIn("echo half >&3; exit 1");
  ::signal(SIGCHLD, SIG_IGN);
  EXPECT_THROW(VideoWriter(folder_ / "a.mp4", 33, 17, 30).close(), InputOutputError);
  ::signal(SIGCHLD, SIG_DFL);
  EXPECT_EQ(folder_.fileCount(), 1) << "no film, not even a part of one";
}

// Ctrl-C goes to the whole process group in front of the terminal.
TEST_F(StandInTest, HasAProcessGroupOfItsOwn) {
  standIn("echo group $(cut -d' ' -f5 /proc/$$/stat) >&2; exit 1");
  const std::string message =
      messageThrownBy<InputOutputError>([&] { VideoWriter(folder_ / "a.mp4", 33, 17, 30).close(); });
  const std::size_t at = message.rfind(' ');
  ASSERT_NE(at, std::string::npos);
  EXPECT_GT(std::atoi(message.c_str() + at), 1) << message;
  EXPECT_NE(std::atoi(message.c_str() + at), ::getpgrp()) << message;
}

TEST_F(VideoWriterTest, WithoutFfmpegSaysHowToGetItAndWhatToUseInstead) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  const std::string message =
      messageThrownBy<InputOutputError>([&] { VideoWriter(folder_ / "a.mp4", 33, 17, 30); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("apt-get install ffmpeg"), std::string::npos) << message;
  EXPECT_NE(message.find("--out frame_%04d.png"), std::string::npos) << message;
  EXPECT_EQ(folder_.fileCount(), 0);
}

}  // namespace
}  // namespace clothsim
