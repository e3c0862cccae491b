// A small plot of numbers over time, as many curves as are given, with the ends of both axes named.
#pragma once

#include <imgui.h>

#include <span>
#include <string>
#include <vector>

namespace clothsim {

struct Curve {
  std::string name;
  ImVec4 color;
  std::vector<float> values;  // as many as there are times
};

// `times` ascend. `unit` stands behind the numbers at the axis, as " J" or " %".
void drawPlot(const char* id, std::span<const float> times, std::span<const Curve> curves, const char* unit);

}  // namespace clothsim
