// The panel Scene: bundled scenes, opening, saving and resetting.
#include <cstdio>

#include "core/error.h"
#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

// A line for a path with a button beside it. True when Enter or the button was pressed.
bool pathLine(const char* id, const char* hint, char* text, std::size_t size, const char* button) {
  ImGui::PushID(id);
  const float buttonWidth = ImGui::CalcTextSize(button).x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(-(buttonWidth + ImGui::GetStyle().ItemInnerSpacing.x));
  bool go = ImGui::InputTextWithHint("##path", hint, text, size, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  go = ImGui::Button(button) || go;
  ImGui::PopID();
  return go && text[0] != '\0';
}

}  // namespace

void ScenePanel::remember(const std::string& path) { std::snprintf(save_, sizeof save_, "%s", path.c_str()); }

void ScenePanel::draw(PanelContext& context) {
  if (!read_) {
    read_ = true;
    try {
      bundled_ = bundledScenes();
    } catch (const Error&) {  // one of the files is broken; the command line tells more
    }
  }
  if (!context.draft.description.empty()) wrappedText(context.draft.description, theme::quiet);
  if (wideButton("Reset to the loaded scene")) context.requests.resetScene = true;
  helpTip("Undoes all parameter changes and restarts.");
  if (pathLine("save", "my_scene.json, cloth.obj", save_, sizeof save_, "Save"))
    context.requests.saveSceneAs = save_;
  helpTip(
      "Saves the scene with its edits as JSON (Ctrl+S). What you did with the mouse is saved by "
      "Ctrl+Shift+S instead. A name ending in .obj, .ply, .csv or .state saves the cloth as it is now.");
  if (pathLine("open", "path of a scene, or drop a file", open_, sizeof open_, "Open"))
    context.requests.openScene = open_;
  helpTip("Opens a scene file. You can also drop one on the window.");
  ImGui::Separator();
  for (const BundledScene& scene : bundled_) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 words = ImGui::CalcTextSize(scene.description.c_str(), nullptr, false, width - 0.4f * em());
    ImGui::PushID(scene.name.c_str());
    if (ImGui::Selectable("##open", scene.name == context.sceneName, 0, {width, words.y + 1.45f * em()}))
      context.requests.openScene = scene.name;
    ImGui::PopID();
    const ImVec2 after = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({at.x + 0.2f * em(), at.y + 0.1f * em()});
    ImGui::TextUnformatted(scene.name.c_str());
    ImGui::SetCursorScreenPos({at.x + 0.2f * em(), at.y + 1.25f * em()});
    wrappedText(scene.description, theme::quiet);
    ImGui::SetCursorScreenPos(after);
  }
}

}  // namespace clothsim
