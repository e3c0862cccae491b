#include "viewer/viewer_marks.h"

#include "viewer/ui_frame.h"

namespace clothsim {

void drawMarks(const MouseMarks& marks) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImU32 light = ImGui::GetColorU32(ImVec4(1, 1, 1, 0.95f)),
              dark = ImGui::GetColorU32(ImVec4(0, 0, 0, 0.45f));
  const float line = 0.11f * em();
  const auto ring = [&](glm::vec2 center, float radius) {
    list.AddCircle({center.x, center.y}, radius, dark, 0, 2.2f * line);
    list.AddCircle({center.x, center.y}, radius, light, 0, line);
  };
  if (marks.goal) ring(*marks.goal, 0.55f * em());
  if (marks.grabbed) {
    const ImVec2 grabbed{marks.grabbed->x, marks.grabbed->y};
    if (marks.goal) {
      list.AddLine({marks.goal->x, marks.goal->y}, grabbed, dark, 2.2f * line);
      list.AddLine({marks.goal->x, marks.goal->y}, grabbed, light, line);
    }
    list.AddCircleFilled(grabbed, 0.26f * em(), dark);
    list.AddCircleFilled(grabbed, 0.19f * em(), light);
  }
  if (marks.nozzle) {
    ring(*marks.nozzle, marks.nozzleRadius);
    ring(*marks.nozzle, 0.45f * marks.nozzleRadius);
  }
  if (marks.stroke.size() > 1) {
    std::vector<ImVec2> points;
    for (const glm::vec2 point : marks.stroke) points.push_back({point.x, point.y});
    const int count = static_cast<int>(points.size());
    list.AddPolyline(points.data(), count, dark, ImDrawFlags_None, 2.2f * line);
    list.AddPolyline(points.data(), count, light, ImDrawFlags_None, line);
  }
}

}  // namespace clothsim
