// The progress bar; what it prints is a pure function, so that it can be tested without a terminal.
#include "core/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace clothsim {

namespace {

// "4 s", "2:05", "1:00:09"
std::string duration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::min(seconds, 3.6e6)));
  char text[32];
  if (whole < 60) {
    std::snprintf(text, sizeof text, "%lld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text;
}

std::string repeated(const char* glyph, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += glyph;
  return text;
}

std::string bar(double fraction, int cells, bool color) {
  const int full = static_cast<int>(fraction * cells);
  const std::string filled = repeated("#", full), empty = repeated(".", cells - full);
  return color ? "\033[32m" + filled + "\033[0m\033[2m" + empty + "\033[0m" : filled + empty;
}

int terminalWidth() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// https://no-color.org: set and not empty, whatever its value.
bool noColor() {
  const char* value = std::getenv("NO_COLOR");
  return value != nullptr && *value != '\0';
}

}  // namespace

std::string progressLine(const std::string& label, std::int64_t done, std::int64_t total, double elapsed,
                         int width, bool color) {
  const double fraction =
      total > 0 ? std::clamp(static_cast<double>(done) / static_cast<double>(total), 0.0, 1.0) : 1.0;
  char percent[8];
  std::snprintf(percent, sizeof percent, "%3d%%", static_cast<int>(fraction * 100));
  std::string after = std::string(" ") + percent + "  " + duration(elapsed);
  if (fraction > 0 && fraction < 1) after += ", " + duration(elapsed * (1 - fraction) / fraction) + " left";

  constexpr int widestBar = 40, narrowestBar = 5;
  const int room = width - static_cast<int>(label.size() + after.size()) - 1;
  if (room >= narrowestBar) return label + " " + bar(fraction, std::min(room, widestBar), color) + after;
  return (label + after).substr(0, static_cast<std::size_t>(std::max(width, 0)));
}

Progress::Progress(std::string label, std::int64_t total)
    : label_(std::move(label)),
      total_(total),
      start_(Clock::now()),
      drawn_(start_ - std::chrono::hours(1)),
      visible_(isatty(STDERR_FILENO) == 1),
      color_(visible_ && !noColor()) {}

Progress::~Progress() { finish(); }

void Progress::update(std::int64_t done) {
  if (!visible_) return;
  const Clock::time_point now = Clock::now();
  if (now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  onScreen_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  // One column is left free: a character in the last one would wrap on some terminals.
  const std::string line = progressLine(label_, done, total_, elapsed, terminalWidth() - 1, color_);
  std::fprintf(stderr, "\r%s\033[K", line.c_str());
  std::fflush(stderr);
}

void Progress::finish() {
  if (!onScreen_) return;
  onScreen_ = false;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

}  // namespace clothsim
