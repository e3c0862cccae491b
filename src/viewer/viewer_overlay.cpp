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

constexpr float narrowPicture = 46;  // em
constexpr float keyMargin = 0.4f;    // on both sides of the name of a key [em]

// Draws the name of a key on a small rounded rectangle, as on a keyboard.
void drawKeyCap(std::string_view name) {
  const ImVec2 size = ImGui::CalcTextSize(name.data(), name.data() + name.size());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float margin = keyMargin * em(), lift = 0.1f * em();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x + 2 * margin, at.y + size.y + 2 * lift},
                                            ImGui::GetColorU32(theme::keyCap), 0.25f * em());
  ImGui::SetCursorScreenPos({at.x + margin, at.y + lift});
  coloredText(name, theme::plain);
  // Makes the table column as wide as the cap.
  ImGui::SameLine(0, 0);
  ImGui::Dummy({margin, 1});
}

// Of a column of the list: keys, and what they do.
float widthOfKeyRows(std::size_t first, std::size_t last) {
  float keys = 0, effects = 0;
  for (std::size_t i = first; i < last; ++i) {
    keys = std::max(keys, widthOf(viewerKeys[i].input) + 2 * keyMargin * em());
    effects = std::max(effects, widthOf(viewerKeys[i].effect));
  }
  return keys + effects + 4 * ImGui::GetStyle().CellPadding.x;
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
  // The text is measured first, since a window that sizes itself does so a frame late. Long values are
  // wrapped, so that the card leaves the other side of the picture to the axes.
  float labels = 0, values = 0;
  for (const OverlayFacts::Row& row : facts.rows) {
    labels = std::max(labels, widthOf(row.label));
    values = std::max(values, widthOf(row.value));
  }
  labels += 0.9f * em();
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const float line = 1.35f * em(), titleHeight = 2 * em(), edge = 0.8f * em(), besideAxes = 7.5f * em();
  const float most = area.width - besideAxes - edge - labels - 2 * padding.x;
  values = std::min(values, std::max(most, 9 * em()));
  const auto heightOf = [&](const OverlayFacts::Row& row) {
    const float oneLine = ImGui::GetTextLineHeight();
    return line - oneLine + ImGui::CalcTextSize(row.value.c_str(), nullptr, false, values + 1).y;
  };
  float height = titleHeight + 2 * padding.y;
  for (const OverlayFacts::Row& row : facts.rows) height += heightOf(row);
  ImGui::SetNextWindowPos({edge, edge});
  ImGui::SetNextWindowSize({labels + values + 2 * padding.x, height});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::glass);
  ImGui::Begin("facts", nullptr, overlayFlags & ~ImGuiWindowFlags_AlwaysAutoResize);
  titleText(facts.title);
  float y = padding.y + titleHeight;
  for (const OverlayFacts::Row& row : facts.rows) {
    ImGui::SetCursorPos({padding.x, y});
    quietText(row.label);
    ImGui::SetCursorPos({padding.x + labels, y});
    ImGui::PushTextWrapPos(padding.x + labels + values + 1);
    coloredText(row.value, row.alert ? theme::alert : theme::plain);
    ImGui::PopTextWrapPos();
    y += heightOf(row);
  }
  ImGui::End();
  ImGui::PopStyleColor();
}

void drawKeyList(PictureArea area) {
  // One column or two, whichever allows the larger text, so that nothing needs scrolling. Where the picture
  // is too small the list also covers the panels.
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  constexpr std::size_t count = viewerKeys.size(), half = (count + 1) / 2;
  const float gap = 1.6f * em(), margins = 2 * ImGui::GetStyle().WindowPadding.x + 0.5f * em();
  const float oneWide = widthOfKeyRows(0, count) + margins,
              twoWide = widthOfKeyRows(0, half) + gap + widthOfKeyRows(half, count) + margins;
  const auto scaleFor = [&](float width, std::size_t lines) {
    return std::min({1.0f, whole.x / width, whole.y / ((1.7f * static_cast<float>(lines) + 4) * em())});
  };
  const float scaleOfOne = scaleFor(oneWide, count), scaleOfTwo = scaleFor(twoWide, half);
  const bool twoColumns = scaleOfTwo >= scaleOfOne;
  const float scale = twoColumns ? scaleOfTwo : scaleOfOne, width = scale * (twoColumns ? twoWide : oneWide);
  const float middle = area.width > width ? area.width / 2 : whole.x / 2;
  ImGui::SetNextWindowPos({middle, area.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::sheet);
  // The wheel and clicks do not reach what lies under it.
  ImGui::Begin("keys", nullptr, overlayFlags & ~ImGuiWindowFlags_NoInputs);
  ImGui::SetWindowFontScale(scale);
  titleText("Keys and mouse");
  ImGui::BeginGroup();
  drawKeyRows(0, twoColumns ? half : count);
  ImGui::EndGroup();
  if (twoColumns) {
    ImGui::SameLine(0, scale * gap);
    ImGui::BeginGroup();
    ImGui::PushID("second");
    drawKeyRows(half, count);
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
