#include "viewer/frame_timings.h"

#include <cstdio>

namespace clothsim {

std::string FrameTimings::report() const {
  if (frames_ == 0) return "";
  constexpr std::array<const char*, PHASES> names{
      "input",         "simulation", "picture of the scene", "panels, laid out",
      "panels, drawn", "swap",       "what controls ask for"};
  double whole = 0;
  for (const double seconds : host_) whole += seconds;
  char line[128];
  std::snprintf(line, sizeof line, "%d frames, milliseconds of each%28s\n", frames_, "host  share  device");
  std::string text = line;
  for (std::size_t i = 0; i < PHASES; ++i) {
    std::snprintf(line, sizeof line, "  %-24s %28.3f  %4.1f%%  %6.3f\n", names[i], 1e3 * host_[i] / frames_,
                  100 * host_[i] / whole, 1e3 * device_[i] / frames_);
    text += line;
  }
  std::snprintf(line, sizeof line, "  %-24s %28.3f\n", "whole frame", 1e3 * whole / frames_);
  text += line;
  std::snprintf(line, sizeof line, "simulated %.2f s in %.2f s: %.2f of real time, %.1f frames/s\n",
                simulated_, whole, simulated_ / whole, frames_ / whole);
  return text + line;
}

}  // namespace clothsim
