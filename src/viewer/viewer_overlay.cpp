#include "viewer/viewer_overlay.h"

#include <algorithm>
#include <cmath>

#include "core/formatted.h"
#include "viewer/ui_frame.h"
#include "viewer/viewer_keys.h"

namespace clothsim {
namespace {

constexpr ImGuiWindowFlags overlayFlags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
    ImGuiWindowFlags_NoFocusOnAppearing;

constexpr float keyColumnWidth = 27;  // of the list of keys [em]
constexpr float narrowPicture = 46;   // em

// Draws the name of a key on a small rounded rectangle, as on a keyboard.
void drawKeyCap(std::string_view name) {
  const ImVec2 size = ImGui::CalcTextSize(name.data(), name.data() + name.size());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float margin = 0.4f * em(), lift = 0.1f * em();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x + 2 * margin, at.y + size.y + 2 * lift},
                                            ImGui::GetColorU32(theme::keyCap), 0.25f * em());
  ImGui::SetCursorScreenPos({at.x + margin, at.y + lift});
  coloredText(name, theme::plain);
  // Makes the table column as wide as the cap.
  ImGui::SameLine(0, 0);
  ImGui::Dummy({margin, 1});
}

void drawKeyRows(std::size_t first, std::size_t last) {
  if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) return;
  for (std::size_t i = first; i < last; ++i) {
    ImGui::TableNextRow(ImGuiTableRowFlags_None, 1.5f * em());
    ImGui::TableNextColumn();
    drawKeyCap(viewerKeys[i].input);
    ImGui::TableNextColumn();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 0.1f * em());
    coloredText(viewerKeys[i].effect, theme::plain);
  }
  ImGui::EndTable();
}

}  // namespace

void drawFacts(const OverlayFacts& all, PictureArea area) {
  OverlayFacts facts = all;
  if (area.width < narrowPicture * em())
    std::erase_if(facts.rows, [](const OverlayFacts::Row& row) { return !row.important; });
  // The text is measured first, since a window that sizes itself does so a frame late.
  const auto widthOf = [](const std::string& words) { return ImGui::CalcTextSize(words.c_str()).x; };
  float labels = 0, values = 0;
  for (const OverlayFacts::Row& row : facts.rows) {
    labels = std::max(labels, widthOf(row.label));
    values = std::max(values, widthOf(row.value));
  }
  labels += 0.9f * em();
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const float line = 1.35f * em(), titleHeight = 2 * em();
  ImGui::SetNextWindowPos({0.8f * em(), 0.8f * em()});
  ImGui::SetNextWindowSize({labels + values + 2 * padding.x,
                            titleHeight + line * static_cast<float>(facts.rows.size()) + 2 * padding.y});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::glass);
  ImGui::Begin("facts", nullptr, overlayFlags & ~ImGuiWindowFlags_AlwaysAutoResize);
  titleText(facts.title);
  float y = padding.y + titleHeight;
  for (const OverlayFacts::Row& row : facts.rows) {
    ImGui::SetCursorPos({padding.x, y});
    quietText(row.label);
    ImGui::SetCursorPos({padding.x + labels, y});
    coloredText(row.value, row.alert ? theme::alert : theme::plain);
    y += line;
  }
  ImGui::End();
  ImGui::PopStyleColor();
}

void drawKeyList(PictureArea area) {
  // One column or two, whichever allows the larger text, so that nothing needs scrolling. Where the picture
  // is too small the list also covers the panels.
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const auto scaleFor = [&](float columns) {
    const float lines = std::ceil(static_cast<float>(viewerKeys.size()) / columns);
    return std::min(
        {1.0f, whole.x / (keyColumnWidth * columns * em()), whole.y / ((1.7f * lines + 4) * em())});
  };
  const bool twoColumns = scaleFor(2) >= scaleFor(1);
  const float scale = scaleFor(twoColumns ? 2 : 1),
              width = keyColumnWidth * (twoColumns ? 2 : 1) * scale * em();
  const float middle = area.width > width ? area.width / 2 : whole.x / 2;
  ImGui::SetNextWindowPos({middle, area.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::sheet);
  ImGui::Begin("keys", nullptr, overlayFlags);
  ImGui::SetWindowFontScale(scale);
  titleText("Keys and mouse");
  const std::size_t half = twoColumns ? (viewerKeys.size() + 1) / 2 : viewerKeys.size();
  ImGui::BeginGroup();
  drawKeyRows(0, half);
  ImGui::EndGroup();
  if (twoColumns) {
    ImGui::SameLine(0, 1.6f * em());
    ImGui::BeginGroup();
    ImGui::PushID("second");
    drawKeyRows(half, viewerKeys.size());
    ImGui::PopID();
    ImGui::EndGroup();
  }
  ImGui::End();
  ImGui::PopStyleColor();
}

void drawLoading(const std::string& name) {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, whole, ImGui::GetColorU32(theme::column));
  ImGui::SetNextWindowPos({whole.x / 2, whole.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::column);
  ImGui::Begin("loading", nullptr, overlayFlags);
  titleText("Loading " + name + " ...");
  quietText("Esc quits");
  ImGui::End();
  ImGui::PopStyleColor();
}

DrawnAdvice drawAdvice(const PaceAdvice& advice, double tempo, PictureArea area, float lift) {
  DrawnAdvice drawn;
  float widest = 0;
  for (const PaceRemedy& remedy : advice.remedies)
    widest = std::max(widest, ImGui::CalcTextSize(remedy.name.c_str()).x);
  const float width = widest + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextWindowPos({0.8f * em(), area.height - lift - 0.8f * em()}, ImGuiCond_Always, {0, 1});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::glass);
  ImGui::Begin("advice", nullptr, overlayFlags & ~ImGuiWindowFlags_NoInputs);
  coloredText(advice.cause, theme::alert);
  for (const PaceRemedy& remedy : advice.remedies) {
    if (ImGui::Button(remedy.name.c_str(), {width, 0})) drawn.pressed = remedy;
    helpTip(remedy.tempo
                ? "As it runs anyway, but evenly (S)."
                : "Tried on this machine just now. A change of the cloth or the solver can be undone "
                  "(Ctrl+Z).");
    if (!remedy.pace) continue;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const bool holds = *remedy.pace >= 0.95 * tempo;
    coloredText(remedy.tempo ? "steady"
                : holds      ? "real time"
                             : formatted("%.2f\u00d7", *remedy.pace),
                holds || remedy.tempo ? theme::good : theme::quiet);
  }
  drawn.height = ImGui::GetWindowHeight();
  ImGui::End();
  ImGui::PopStyleColor();
  return drawn;
}

void drawNotice(const std::string& words, bool isError, PictureArea area, float lift) {
  ImGui::SetNextWindowPos({area.width / 2, area.height - lift - 0.8f * em()}, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, isError ? theme::sheet : theme::glass);
  ImGui::Begin("notice", nullptr, overlayFlags);
  ImGui::PushTextWrapPos(std::max(12 * em(), 0.9f * area.width));
  coloredText(words, isError ? theme::alert : theme::plain);
  ImGui::PopTextWrapPos();
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace clothsim
