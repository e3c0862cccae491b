#include "core/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>

namespace clothsim {
namespace {

TEST(ProgressLine, ShowsLabelPercentElapsedAndRemainingTime) {
  const std::string line = progressLine("Rendering", 25, 100, 10, 79, false);
  EXPECT_NE(line.find("Rendering"), std::string::npos);
  EXPECT_NE(line.find("25%"), std::string::npos);
  EXPECT_NE(line.find("10 s"), std::string::npos);
  EXPECT_NE(line.find("30 s left"), std::string::npos);  // a quarter took 10 s
  EXPECT_NE(line.find("##########......"), std::string::npos);
}

TEST(ProgressLine, WritesLongTimesInMinutesAndHours) {
  EXPECT_NE(progressLine("x", 1, 2, 125, 79, false).find("2:05, 2:05 left"), std::string::npos);
  EXPECT_NE(progressLine("x", 1, 2, 3609, 79, false).find("1:00:09"), std::string::npos);
}

TEST(ProgressLine, NeverGuessesTheRemainingTimeBeforeAnythingIsDone) {
  EXPECT_EQ(progressLine("x", 0, 100, 5, 79, false).find("left"), std::string::npos);
}

TEST(ProgressLine, StaysWithinTheTerminalsWidth) {
  for (int width = 0; width < 120; ++width)
    EXPECT_LE(progressLine("Rendering frames", 3, 7, 1234, width, false).size(),
              static_cast<std::size_t>(width));
}

TEST(ProgressLine, CopesWithTotalsOfZeroAndCountsBeyondTheTotal) {
  EXPECT_NE(progressLine("x", 0, 0, 1, 79, false).find("100%"), std::string::npos);
  EXPECT_NE(progressLine("x", 12, 10, 1, 79, false).find("100%"), std::string::npos);
}

TEST(ProgressLine, HoldsEscapesOnlyInColour) {
  EXPECT_EQ(progressLine("x", 1, 2, 1, 79, false).find('\033'), std::string::npos);
  EXPECT_NE(progressLine("x", 1, 2, 1, 79, true).find('\033'), std::string::npos);
}

// What a Progress writes when stderr is the other end of a new terminal. The kernel passes it on in its own
// time, so a bell is written after it and waited for.
std::string writtenToTerminal() {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  EXPECT_GE(terminal, 0);
  EXPECT_EQ(grantpt(terminal), 0);
  EXPECT_EQ(unlockpt(terminal), 0);
  const int end = open(ptsname(terminal), O_RDWR | O_NOCTTY);
  const int before = dup(STDERR_FILENO);
  dup2(end, STDERR_FILENO);
  {
    Progress progress("Simulating", 4);
    progress.update(1);
    progress.finish();
  }
  dup2(before, STDERR_FILENO);
  close(before);
  EXPECT_EQ(write(end, "\a", 1), 1);
  std::string written;
  pollfd arrival{terminal, POLLIN, 0};
  while (!written.ends_with('\a') && poll(&arrival, 1, 30'000) == 1) {
    std::array<char, 4096> bytes{};
    const ssize_t count = read(terminal, bytes.data(), bytes.size());
    if (count <= 0) break;
    written.append(bytes.data(), static_cast<std::size_t>(count));
  }
  close(end);
  close(terminal);
  EXPECT_TRUE(written.ends_with('\a')) << "the terminal did not pass on all that was written";
  return written.substr(0, written.find('\a'));
}

TEST(Progress, DrawsOnATerminalAndClearsItsLineAtTheEnd) {
  unsetenv("NO_COLOR");
  const std::string written = writtenToTerminal();
  EXPECT_NE(written.find("Simulating"), std::string::npos);
  EXPECT_NE(written.find("25%"), std::string::npos);
  EXPECT_NE(written.find("\033[32m"), std::string::npos);
  EXPECT_TRUE(written.ends_with("\r\033[K"));
}

TEST(Progress, HonoursNoColor) {
  setenv("NO_COLOR", "1", 1);
  const std::string written = writtenToTerminal();
  unsetenv("NO_COLOR");
  EXPECT_NE(written.find("25%"), std::string::npos);
  EXPECT_EQ(written.find("\033[32m"), std::string::npos);
}

TEST(Progress, WritesNothingWhenStderrIsNoTerminal) {
  testing::internal::CaptureStderr();
  {
    Progress progress("Simulating", 10);
    progress.update(5);
    progress.update(10);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace clothsim
