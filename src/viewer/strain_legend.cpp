#include "viewer/strain_legend.h"

#include <algorithm>
#include <vector>

#include "core/formatted.h"
#include "render/strain_scale.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

ImU32 colorOf(const StrainStop& stop) {
  return ImGui::GetColorU32(ImVec4(stop.srgb[0], stop.srgb[1], stop.srgb[2], 1));
}

void drawScale(const RenderSettings& look, std::optional<double> underCursor) {
  const std::vector<StrainStop> stops = strainScale(look);
  const double low = stops.front().strain, span = stops.back().strain - low;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 0.8f * em();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto place = [&](double strain) {
    return at.x + width * static_cast<float>(std::clamp((strain - low) / span, 0.0, 1.0));
  };
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const ImU32 left = colorOf(stops[i]), right = colorOf(stops[i + 1]);
    list.AddRectFilledMultiColor({place(stops[i].strain), at.y}, {place(stops[i + 1].strain), at.y + height},
                                 left, right, right, left);
  }
  if (underCursor) {
    const float x = place(*underCursor);
    list.AddRectFilled({x - 2, at.y - 3}, {x + 2, at.y + height + 3}, ImGui::GetColorU32(theme::plain), 1);
  }
  ImGui::Dummy({width, height + 0.1f * em()});
  const std::string most = formatted("%+.3g %%", 100 * stops.back().strain);
  quietText(formatted("%+.3g %%", 100 * low));
  ImGui::SameLine(ImGui::GetCursorPosX() + 0.5f * width - 0.5f * em());
  quietText("0");
  ImGui::SameLine(ImGui::GetCursorPosX() + width - ImGui::CalcTextSize(most.c_str()).x);
  quietText(most);
}

}  // namespace

void drawStrainLegend(const RenderSettings& look, std::optional<double> underCursor, PictureArea area,
                      float lift) {
  const float edge = 0.8f * em(), width = std::min(16 * em(), area.width - 2 * edge);
  ImGui::SetNextWindowPos({area.width - edge, area.height - lift - edge}, ImGuiCond_Always, {1, 1});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::glass);
  ImGui::Begin("strain", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  drawScale(look, underCursor);
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace clothsim
