#include "viewer/panels/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

struct Axis {
  float low = 0, high = 1;
};

// The range of all curves; it contains zero and a margin above.
Axis valueAxis(std::span<const Curve> curves) {
  Axis axis{0, 0};
  for (const Curve& curve : curves)
    for (const float value : curve.values) {
      axis.low = std::min(axis.low, value);
      axis.high = std::max(axis.high, value);
    }
  // The margin has room for the names of the curves.
  const float span = std::max(axis.high - axis.low, 1e-6f);
  return {axis.low < 0 ? axis.low - 0.06f * span : 0, axis.high + 0.3f * span};
}

std::string numberText(float value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3g%s", static_cast<double>(value), unit);
  return text;
}

// Draws the names of the curves in their colours, each with its last value.
void drawLegend(std::span<const Curve> curves, const char* unit) {
  for (const Curve& curve : curves) {
    const std::string words =
        curve.name + " " + numberText(curve.values.empty() ? 0 : curve.values.back(), unit);
    const float right = ImGui::GetWindowContentRegionMax().x;
    if (&curve != &curves.front()) {
      const float begin = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + 0.8f * em();
      if (begin + ImGui::CalcTextSize(words.c_str()).x < right) ImGui::SameLine(0, 0.8f * em());
    }
    coloredText(words, curve.color);
  }
}

}  // namespace

void drawPlot(const char* id, std::span<const float> times, std::span<const Curve> curves, const char* unit) {
  drawLegend(curves, unit);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, 5.5f * em()};
  ImGui::InvisibleButton(id, size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                     ImGui::GetStyle().FrameRounding);
  if (times.size() < 2) {
    list.AddText({at.x + 0.5f * em(), at.y + 0.4f * em()}, ImGui::GetColorU32(theme::quiet), "measuring");
    return;
  }
  const Axis axis = valueAxis(curves);
  const float margin = 0.35f * em(), width = size.x - 2 * margin, height = size.y - 2 * margin;
  const float first = times.front(), span = std::max(1e-6f, times.back() - first);
  const auto heightOf = [&](float value) {
    return at.y + margin + height * (axis.high - value) / (axis.high - axis.low);
  };
  const float zero = std::round(heightOf(0)) + 0.5f;
  list.AddLine({at.x + margin, zero}, {at.x + size.x - margin, zero}, ImGui::GetColorU32(ImGuiCol_Border));
  std::vector<ImVec2> points(times.size());
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < times.size(); ++i)
      points[i] = {at.x + margin + width * (times[i] - first) / span, heightOf(curve.values[i])};
    list.AddPolyline(points.data(), static_cast<int>(points.size()), ImGui::GetColorU32(curve.color),
                     ImDrawFlags_None, 0.1f * em());
  }
  float peak = 0;
  for (const Curve& curve : curves)
    peak = std::max(peak, *std::max_element(curve.values.begin(), curve.values.end()));
  const ImU32 quiet = ImGui::GetColorU32(theme::quiet);
  const float small = 0.8f * em();
  list.AddText(nullptr, small, {at.x + margin, at.y + 0.15f * em()}, quiet,
               ("most " + numberText(peak, unit)).c_str());
  char spanText[48];
  std::snprintf(spanText, sizeof spanText, "last %.3g s", static_cast<double>(span));
  const float spanWidth = ImGui::CalcTextSize(spanText).x * 0.8f;
  list.AddText(nullptr, small, {at.x + size.x - margin - spanWidth, at.y + 0.15f * em()}, quiet, spanText);
}

}  // namespace clothsim
