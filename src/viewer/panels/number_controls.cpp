#include "viewer/panels/number_controls.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "viewer/panels/field_widgets.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr double briefly = 4;  // s

// What is said below a control, until a time of Dear ImGui's clock.
struct BriefTip {
  ImGuiID of = 0;
  std::string text;
  double until = 0;
};
BriefTip briefTip;

ImGuiID lastControl = 0;

// Below the last control, without a window, whose items would take the place of the control.
void drawBriefTip() {
  if (briefTip.of != lastControl || ImGui::GetTime() > briefTip.until) return;
  const char* text = briefTip.text.c_str();
  const ImVec2 corner = ImGui::GetItemRectMax(), size = ImGui::CalcTextSize(text);
  const float margin = 0.4f * em(), top = corner.y + 0.2f * em();
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRectFilled({corner.x - size.x - 2 * margin, top}, {corner.x, top + size.y + 2 * margin},
                     ImGui::GetColorU32(ImGuiCol_PopupBg), ImGui::GetStyle().PopupRounding);
  list.AddText({corner.x - size.x - margin, top + margin}, ImGui::GetColorU32(theme::alert), text);
}

// What has been typed into a control so far. Dear ImGui's own field for it takes no letters.
struct Typing {
  ImGuiID into = 0;
  std::array<char, 64> text{};
};
Typing typing;

// draw() draws a control of Dear ImGui's called ##value, of the width of the next item, and changes the value
// where it is dragged. Here a field takes its place while a number is typed. True when the value was changed.
template <class Draw>
bool numberControl(double& value, std::string_view unit, Draw draw) {
  const ImGuiID id = ImGui::GetID("##value");
  const double before = value;
  bool changed = false;
  if (ImGui::TempInputIsActive(id)) {
    if (typing.into != id) typing = {id, {}};
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImRect place{at, {at.x + ImGui::CalcItemWidth(), at.y + ImGui::GetFrameHeight()}};
    ImGui::TempInputText(place, id, "##value", typing.text.data(), static_cast<int>(typing.text.size()), 0);
  } else {
    changed = draw();
  }
  lastControl = id;
  drawBriefTip();
  if (ImGui::TempInputIsActive(id)) return false;
  if (typing.into != id) return changed;
  const std::string text = std::exchange(typing, {}).text.data();
  const bool isTakenBack = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  const std::optional<double> number = isTakenBack ? before : numberIn(text, unit);
  value = number.value_or(before);
  if (!number)
    tellBriefly("\"" + text + "\" is no number" + (unit.empty() ? "" : " of " + unitText(unit)) +
                ": it stays");
  return value != before;
}

double shareOf(double value, const Usual& range) {
  return isLogarithmic(range)
             ? std::log(std::max(value, range.low) / range.low) / std::log(range.high / range.low)
             : (value - range.low) / (range.high - range.low);
}

void drawBar(double share) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::CalcItemWidth(), ImGui::GetFrameHeight()};
  const float rounding = ImGui::GetStyle().FrameRounding;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg), rounding);
  const float filled = size.x * static_cast<float>(std::clamp(share, 0.0, 1.0));
  if (filled <= 1) return;
  list.PushClipRect(at, {at.x + filled, at.y + size.y}, true);
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(theme::fill), rounding);
  list.PopClipRect();
}

// ImGui::SliderScalar without its own bar.
bool bareSlider(ImGuiDataType type, void* value, const void* low, const void* high, const std::string& format,
                bool logarithmic) {
  const ImVec4 nothing{0, 0, 0, 0}, veil{1, 1, 1, 0.05f};
  ImGui::PushStyleColor(ImGuiCol_FrameBg, nothing);
  ImGui::PushStyleColor(ImGuiCol_FrameBgHovered, veil);
  ImGui::PushStyleColor(ImGuiCol_FrameBgActive, veil);
  ImGui::PushStyleColor(ImGuiCol_SliderGrab, nothing);
  ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, nothing);
  // Dear ImGui opens the field at a click with Ctrl.
  ImGuiIO& io = ImGui::GetIO();
  const bool control = std::exchange(io.KeyCtrl, io.KeyCtrl || io.MouseDoubleClicked[0]);
  const bool changed = ImGui::SliderScalar("##value", type, value, low, high, format.c_str(),
                                           logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  io.KeyCtrl = control;
  ImGui::PopStyleColor(5);
  const bool isOnlyClicked = ImGui::IsItemActive() && !ImGui::IsMouseDragging(0);
  return changed && !isOnlyClicked;
}

}  // namespace

void tellBriefly(std::string text) { briefTip = {lastControl, std::move(text), ImGui::GetTime() + briefly}; }

bool barSlider(double& value, const Usual& range, std::string_view unit) {
  drawBar(shareOf(value, range));
  return numberControl(value, unit, [&] {
    double slid = value;
    if (!bareSlider(ImGuiDataType_Double, &slid, &range.low, &range.high, numberFormat(unit),
                    isLogarithmic(range)))
      return false;
    value = slid;
    return true;
  });
}

bool barSlider(int& value, const Usual& range, std::string_view unit) {
  drawBar(shareOf(value, range));
  double number = value;
  numberControl(number, unit, [&] {
    int slid = value;
    const int low = static_cast<int>(range.low), high = static_cast<int>(range.high);
    const std::string format = unit.empty() ? "%d" : "%d " + unitText(unit);
    if (!bareSlider(ImGuiDataType_S32, &slid, &low, &high, format, isLogarithmic(range))) return false;
    number = slid;
    return true;
  });
  const double most = std::numeric_limits<int>::max();
  const int before = std::exchange(value, static_cast<int>(std::lround(std::clamp(number, -most, most))));
  return value != before;
}

bool dragVector(Vec3d& value, float speed, std::string_view unit) {
  bool changed = false;
  ImGui::BeginGroup();
  ImGui::PushMultiItemsWidths(3, ImGui::CalcItemWidth());
  for (double* component : {&value.x, &value.y, &value.z}) {
    ImGui::PushID(component == &value.x ? "x" : component == &value.y ? "y" : "z");
    if (component != &value.x) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    const auto drag = [&] {
      return ImGui::DragScalar("##value", ImGuiDataType_Double, component, speed, nullptr, nullptr, "%.4g");
    };
    changed = numberControl(*component, unit, drag) || changed;
    ImGui::PopItemWidth();
    ImGui::PopID();
  }
  ImGui::EndGroup();
  return changed;
}

}  // namespace clothsim
