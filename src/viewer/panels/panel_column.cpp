// The column of panels at the right of the window.
#include <algorithm>
#include <array>
#include <cctype>

#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr float widestEm = 24, narrowestEm = 17;
constexpr int tabsInARow = 3;
constexpr float largestShare = 0.47f;  // of the window, so that the cloth is never hidden

std::string titleOf(std::string_view name) {
  std::string title(name);
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

// In rows of three, so that their names fit into the narrowest column.
void drawTabs(PanelName& open) {
  std::array<std::string, panelNames.size()> titles;
  std::array<const char*, panelNames.size()> labels{};
  for (std::size_t i = 0; i < panelNames.size(); ++i) {
    titles[i] = titleOf(panelNames[i]);
    labels[i] = titles[i].c_str();
  }
  for (int first = 0; first < static_cast<int>(panelNames.size()); first += tabsInARow) {
    ImGui::PushID(first);
    const int now = static_cast<int>(open) - first;
    const int chosen = segmentedButtons("tabs", labels.data() + first, tabsInARow, now);
    if (chosen != now) open = static_cast<PanelName>(first + chosen);
    ImGui::PopID();
  }
  ImGui::Dummy({0, 0.1f * em()});
}

}  // namespace

float PanelColumn::width(float windowWidth, float em) {
  const float wanted = std::clamp(0.27f * windowWidth, narrowestEm * em, widestEm * em);
  return std::floor(std::min(wanted, largestShare * windowWidth));
}

void PanelColumn::drawPanel(PanelName panel, PanelContext& context) {
  switch (panel) {
    case PanelName::scene:
      return scenes_.draw(context);
    case PanelName::cloth:
      return drawClothPanel(context);
    case PanelName::solver:
      return drawSolverPanel(context);
    case PanelName::colliders:
      return drawCollidersPanel(context);
    case PanelName::look:
      return drawLookPanel(context);
    case PanelName::measure:
      context.requests.saveCurves = measures_.draw(context.facts);
      return;
  }
}

void PanelColumn::draw(PanelContext& context, ViewerConfig& config) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float taken = width(window.x, em());
  ImGui::SetNextWindowPos({window.x - taken, 0});
  ImGui::SetNextWindowSize({taken, window.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.55f * em(), 0.55f * em()});
  ImGui::Begin("panels", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  drawTabs(config.panel);
  ImGui::BeginChild(std::string(nameOf(config.panel)).c_str());  // scrolls under the tabs
  drawPanel(config.panel, context);
  ImGui::Dummy({0, 0.3f * em()});
  ImGui::EndChild();
  ImGui::End();
  ImGui::PopStyleVar(2);
  measures_.setOpen(config.panel == PanelName::measure);
}

}  // namespace clothsim
