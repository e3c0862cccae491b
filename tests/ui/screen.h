// A screen without a monitor (Xvfb), the hands at its keyboard and mouse (xdotool) and the eye in front of it
// (import).
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/files.h"
#include "support/command.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace clothsim::test {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Whether the condition comes true within that time.
template <class Condition>
bool eventually(milliseconds time, Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(milliseconds(50));
  }
  return true;
}

struct Picture {
  int width = 0, height = 0;
  std::string rgb;
  friend bool operator==(const Picture&, const Picture&) = default;

  struct Pixel {
    int r, g, b;
  };
  [[nodiscard]] Pixel at(int x, int y) const {
    const std::size_t place =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    const auto value = [&](std::size_t i) {
      return static_cast<int>(static_cast<unsigned char>(rgb[place + i]));
    };
    return {value(0), value(1), value(2)};
  }
  // Without what lies below, as the bar with the number of the frame.
  [[nodiscard]] Picture upper(double part) const {
    Picture cut{width, static_cast<int>(part * height), ""};
    cut.rgb = rgb.substr(0, 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(cut.height));
    return cut;
  }
  // The share of pixels for which the condition holds, in a rectangle given in fractions of the picture.
  template <class Condition>
  [[nodiscard]] double share(double left, double top, double right, double bottom,
                             Condition&& condition) const {
    int all = 0, found = 0;
    for (int y = static_cast<int>(top * height); y < static_cast<int>(bottom * height); ++y)
      for (int x = static_cast<int>(left * width); x < static_cast<int>(right * width); ++x, ++all)
        found += condition(at(x, y));
    return all == 0 ? 0 : static_cast<double>(found) / all;
  }
};

// The mark of a pin.
inline bool isPinYellow(Picture::Pixel p) { return p.r > 235 && p.g > 185 && p.b < 80; }

class Screen {
 public:
  Screen(int width, int height) {
    const std::string numberFile = (folder_ / "display").string();
    // The server chooses a free display by itself and writes its number to file descriptor 1.
    // Without -noreset it would start afresh, and refuse connections meanwhile, whenever its last client
    // leaves.
    server_ = std::make_unique<Process>(
        std::vector<std::string>{"sh", "-c",
                                 "exec Xvfb -displayfd 1 -nolisten tcp -noreset -screen 0 " +
                                     std::to_string(width) + "x" + std::to_string(height) +
                                     "x24 2>/dev/null"},
        numberFile);
    const bool up = eventually(seconds(20), [&] {
      std::error_code ignored;
      const auto size = std::filesystem::file_size(numberFile, ignored);
      return !ignored && size > 1 && readFile(numberFile).back() == '\n';
    });
    EXPECT_TRUE(up) << "Xvfb does not start";
    if (!up) return;
    std::string number = readFile(numberFile);
    number.pop_back();
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
  }
  ~Screen() { ::unsetenv("DISPLAY"); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

 private:
  TemporaryFolder folder_;
  std::unique_ptr<Process> server_;
};

// The viewer in its window, in an empty folder of its own, with settings of its own.
class ViewerProgram {
 public:
  // `environment`: as before a command, "NAME=value". `titleOfStart`: what the title says once it has begun;
  // it has the frame rate once pictures are being drawn.
  // @throws std::runtime_error, which fails the test, when no window shows pictures after a while
  explicit ViewerProgram(const std::string& arguments, const std::string& environment = "",
                         const std::string& titleOfStart = "fps")
      : process_(
            {"sh", "-c",
             "cd '" + folder_.path().string() + "' && mkdir here && cd here && exec env XDG_CONFIG_HOME='" +
                 (folder_ / "config").string() + "' " + environment + " " CLOTHSIM_PROGRAM " " + arguments},
            (folder_ / "output").string()) {
    const bool shown = eventually(
        seconds(60), [&] { return !process_.running() || title().find(titleOfStart) != std::string::npos; });
    if (!shown || !process_.running())
      throw std::runtime_error("the viewer does not get going; its title: '" + title() + "'; it says:\n" +
                               output());
  }

  [[nodiscard]] std::string title() const {
    findWindow();
    if (window_.empty()) return "";
    return runCommand("xdotool getwindowname " + window_ + " 2>/dev/null").output;
  }
  [[nodiscard]] std::string output() const { return readFile(folder_ / "output"); }
  // Where it was started.
  [[nodiscard]] std::filesystem::path here() const { return folder_ / "here"; }
  [[nodiscard]] bool leftNoFiles() const { return std::filesystem::is_empty(here()); }
  // Its settings as text; empty while there are none.
  [[nodiscard]] std::string settings() const {
    const std::filesystem::path path = folder_ / "config" / "clothsim" / "viewer.json";
    return std::filesystem::exists(path) ? readFile(path) : "";
  }
  [[nodiscard]] bool eventuallyHas(const std::string& file) const {
    return eventually(seconds(20), [&] { return std::filesystem::exists(here() / file); });
  }
  [[nodiscard]] bool titleBecomesOneWith(const std::string& part) const {
    return eventually(seconds(20), [&] { return title().find(part) != std::string::npos; });
  }

  void press(const std::string& key) const { (void)runCommand("xdotool key " + key); }
  // Does what xdotool's words say; "at X Y" moves to a place given in fractions of the window.
  void perform(const std::string& words) const {
    const Picture now = picture();
    std::istringstream in(words);
    std::string command = "xdotool", word;
    while (in >> word) {
      if (word != "at") {
        command += " " + word;
        continue;
      }
      double x = 0, y = 0;
      in >> x >> y;
      command += " mousemove --window " + window_ + " " + std::to_string(static_cast<int>(x * now.width)) +
                 " " + std::to_string(static_cast<int>(y * now.height));
    }
    (void)runCommand(command);
  }
  // Moves there (fractions of the window), presses the button, moves on, lets go.
  void drag(int button, double fromX, double fromY, double toX, double toY) const {
    const Picture now = picture();
    const auto move = [&](double x, double y) {
      std::ostringstream words;
      words << " mousemove --window " << window_ << " " << static_cast<int>(x * now.width) << " "
            << static_cast<int>(y * now.height) << " sleep 0.2";
      return words.str();
    };
    const std::string name = std::to_string(button);
    (void)runCommand("xdotool" + move(fromX, fromY) + " mousedown " + name + " sleep 0.2" +
                     move((fromX + toX) / 2, (fromY + toY) / 2) + move(toX, toY) + " mouseup " + name);
  }
  void click(int button, int times) const {
    (void)runCommand("xdotool click --repeat " + std::to_string(times) + " --delay 60 " +
                     std::to_string(button));
  }

  [[nodiscard]] Picture picture() const {
    const std::string ppm = runCommand("import -window " + window_ + " -depth 8 ppm:- 2>/dev/null").output;
    Picture picture;
    int start = 0;
    if (std::sscanf(ppm.c_str(), "P6 %d %d 255%n", &picture.width, &picture.height, &start) == 2)
      picture.rgb = ppm.substr(static_cast<std::size_t>(start) + 1);
    EXPECT_EQ(picture.rgb.size(),
              3u * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    return picture;
  }
  // The picture once it has stopped changing: two in a row that are equal, so long after each other.
  [[nodiscard]] Picture stillPicture(milliseconds apart = milliseconds(300),
                                     milliseconds atMost = seconds(40)) const {
    Picture last = picture();
    EXPECT_TRUE(eventually(atMost, [&] {
      std::this_thread::sleep_for(apart);
      Picture next = picture();
      const bool still = next == last;
      last = std::move(next);
      return still;
    })) << "the picture goes on changing";
    return last;
  }
  std::optional<int> exitCodeWithin(milliseconds time) { return process_.waitFor(time); }

 private:
  TemporaryFolder folder_;
  // Again and again: a viewer whose context is lost opens another window.
  void findWindow() const {
    window_ = runCommand("xdotool search --onlyvisible --class clothsim 2>/dev/null").output;
    while (!window_.empty() && window_.back() == '\n') window_.pop_back();
  }

  Process process_;
  mutable std::string window_;
};

}  // namespace clothsim::test
