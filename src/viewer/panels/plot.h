// A small plot of curves over time, with numbers at the ends of both axes.
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

// `times` ascend. `unit`, such as " J" or " %", follows the numbers at the axis.
void drawPlot(const char* id, std::span<const float> times, std::span<const Curve> curves, const char* unit);

}  // namespace clothsim
