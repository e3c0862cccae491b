// The column of panels at the right of the window.
#include <algorithm>
#include <cctype>

#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr float widestEm = 24, narrowestEm = 17;
constexpr float largestShare = 0.47f;  // of the window, so that the cloth is never hidden

std::string titleOf(std::string_view name) {
  std::string title(name);
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

}  // namespace

float PanelColumn::width(float windowWidth, float em) {
  const float wanted = std::clamp(0.27f * windowWidth, narrowestEm * em, widestEm * em);
  return std::floor(std::min(wanted, largestShare * windowWidth));
}

void PanelColumn::drawPanel(PanelName panel, PanelContext& context) {
  switch (panel) {
    case PanelName::simulation:
      return drawSimulationPanel(context);
    case PanelName::colliders:
      return drawCollidersPanel(context);
    case PanelName::look:
      return drawLookPanel(context);
    case PanelName::measure:
      return measures_.draw(context.facts, context.draft.render);
    case PanelName::scene:
      return scenes_.draw(context);
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
  for (std::size_t i = 0; i < panelNames.size(); ++i) {
    ImGui::SetNextItemOpen(config.open[i]);
    config.open[i] = ImGui::CollapsingHeader(titleOf(panelNames[i]).c_str());
    if (!config.open[i]) continue;
    ImGui::PushID(static_cast<int>(i));
    ImGui::Indent(0.25f * em());
    drawPanel(static_cast<PanelName>(i), context);
    ImGui::Unindent(0.25f * em());
    ImGui::Dummy({0, 0.3f * em()});
    ImGui::PopID();
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  measures_.setOpen(config.open[static_cast<std::size_t>(PanelName::measure)]);
}

}  // namespace clothsim
