#include "viewer/axis_gizmo.h"

#include <algorithm>

#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr float fromCorner = 3.2f, armLength = 1.9f, markRadius = 0.62f;  // em
constexpr std::array names{"X", "Y", "Z"};

glm::vec2 middleOf(PictureArea area, float em) { return {area.width - fromCorner * em, fromCorner * em}; }

ImU32 dimmed(ImVec4 color, float light, float alpha) {
  return ImGui::GetColorU32({light * color.x, light * color.y, light * color.z, alpha});
}

}  // namespace

std::array<AxisEnd, 6> axisEnds(const Camera& camera, PictureArea area, float em) {
  const glm::mat3 viewFromWorld(camera.view());
  const glm::vec2 middle = middleOf(area, em);
  std::array<AxisEnd, 6> ends{};
  for (int i = 0; i < 6; ++i) {
    const int axis = i / 2;
    const bool positive = i % 2 == 0;
    const glm::vec3 seen = positive ? viewFromWorld[axis] : -viewFromWorld[axis];
    ends[static_cast<std::size_t>(i)] = {axis, positive, middle + armLength * em * glm::vec2(seen.x, -seen.y),
                                         seen.z};
  }
  std::sort(ends.begin(), ends.end(),
            [](const AxisEnd& a, const AxisEnd& b) { return a.toViewer < b.toViewer; });
  return ends;
}

std::optional<AxisEnd> axisEndAt(const Camera& camera, PictureArea area, float em, glm::vec2 place) {
  const std::array<AxisEnd, 6> ends = axisEnds(camera, area, em);
  for (auto end = ends.rbegin(); end != ends.rend(); ++end)
    if (glm::distance(end->place, place) <= markRadius * em) return *end;
  return std::nullopt;
}

void drawAxes(const Camera& camera, PictureArea area) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const glm::vec2 middle = middleOf(area, em());
  for (const AxisEnd& end : axisEnds(camera, area, em())) {
    const ImVec4 color = theme::axes[static_cast<std::size_t>(end.axis)];
    const float light = 0.8f + 0.2f * end.toViewer;  // what points away is darker
    const ImVec2 at{end.place.x, end.place.y};
    if (!end.positive) {
      list.AddCircleFilled(at, 0.7f * markRadius * em(), dimmed(color, 0.6f * light, 0.55f));
      continue;
    }
    list.AddLine({middle.x, middle.y}, at, dimmed(color, light, 1), 0.14f * em());
    list.AddCircleFilled(at, markRadius * em(), dimmed(color, light, 1));
    const char* const name = names[static_cast<std::size_t>(end.axis)];
    const ImVec2 size = ImGui::CalcTextSize(name);
    list.AddText({at.x - 0.5f * size.x, at.y - 0.5f * size.y}, ImGui::GetColorU32(theme::column), name);
  }
}

}  // namespace clothsim
