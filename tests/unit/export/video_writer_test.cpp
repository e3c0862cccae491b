#include <gtest/gtest.h>

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

TEST_F(VideoWriterTest, LeavesTheOldFilmWhenItIsAbandoned) {
  writeFileAtomically(folder_ / "a.mp4", "old");
  {
    VideoWriter writer(folder_ / "a.mp4", 33, 17, 30);
    writer.addFrame(frame_);
  }
  EXPECT_EQ(readFile(folder_ / "a.mp4"), "old");
  EXPECT_EQ(folder_.fileCount(), 1) << "a temporary file was left behind";
}

// More frames than the connection can hold in flight: a writer that did not mind SIGPIPE would end the test
// here.
TEST_F(VideoWriterTest, PassesOnWhatFfmpegSaysWhenItFails) {
  const std::string message = messageThrownBy<InputOutputError>([&] {
    VideoWriter writer(folder_ / "missing/a.mp4", 33, 17, 30);
    for (int i = 0; i < 5000; ++i) writer.addFrame(frame_);
    writer.close();
  });
  EXPECT_NE(message.find("missing/a.mp4"), std::string::npos) << message;
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
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
