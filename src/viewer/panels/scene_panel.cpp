// The panel Scene: opening, saving and resetting, and the bundled scenes with their pictures.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "core/error.h"
#include "export/export.h"
#include "render/textures.h"
#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr float pictureShape = 0.625f;  // height by width of the thumbnails

ImTextureID textureOf(const gl::Texture& texture) {
  return reinterpret_cast<ImTextureID>(
      static_cast<std::uintptr_t>(texture.name()));  // as its OpenGL backend wants
}

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

// A picture with a name below it. True when it was clicked.
bool drawCard(const std::string& name, const gl::Texture& picture, float width, bool isOpen) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = std::floor(pictureShape * width), rounding = 0.3f * em();
  const bool pressed = ImGui::InvisibleButton(name.c_str(), {width, height + 1.5f * em()});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 corner{at.x + width, at.y + height};
  if (picture.name() != 0)
    list.AddImageRounded(textureOf(picture), at, corner, {0, 0}, {1, 1}, IM_COL32_WHITE, rounding);
  const bool marked = isOpen || ImGui::IsItemHovered();
  if (marked)
    list.AddRect(at, corner, ImGui::GetColorU32(isOpen ? theme::accent : theme::quiet), rounding, 0,
                 0.15f * em());
  list.AddText({at.x + 0.1f * em(), corner.y + 0.15f * em()},
               ImGui::GetColorU32(marked ? theme::plain : theme::quiet), name.c_str());
  return pressed;
}

}  // namespace

void ScenePanel::remember(const std::string& path) {
  std::snprintf(save_, sizeof save_, "%s", path.c_str());
  files_ = sceneFilesIn(".");  // a scene may have come
}

void ScenePanel::readScenes() {
  if (read_) return;
  read_ = true;
  files_ = sceneFilesIn(".");
  try {
    for (BundledScene& scene : bundledScenes()) cards_.push_back({std::move(scene), {}});
  } catch (const Error&) {  // one of the files is broken; the command line tells more
  }
  for (Card& card : cards_) {
    try {
      card.picture = loadPicture(card.scene.thumbnail);
    } catch (const InputOutputError&) {  // its name alone is shown
    }
  }
}

void ScenePanel::drawCards(PanelContext& context) {
  const float gap = 0.5f * em(), available = ImGui::GetContentRegionAvail().x;
  const float width = std::floor((available - gap) / 2);
  for (std::size_t i = 0; i < cards_.size(); ++i) {
    if (i % 2 == 1) ImGui::SameLine(0, gap);
    const BundledScene& scene = cards_[i].scene;
    if (drawCard(scene.name, cards_[i].picture, width, scene.name == context.sceneName))
      context.requests.openScene = scene.name;
    helpTip(scene.description);
  }
}

void ScenePanel::draw(PanelContext& context) {
  readScenes();
  titleText(context.sceneName);
  if (!context.draft.description.empty()) wrappedText(context.draft.description, theme::quiet);
  if (wideButton("Reset to the loaded scene")) context.requests.resetScene = true;
  helpTip("Undoes all parameter changes and restarts.");
  if (pathLine("save", "my_scene.json, cloth.obj", save_, sizeof save_, "Save"))
    context.requests.saveSceneAs = save_;
  helpTip(
      "Saves the scene with its edits as JSON (Ctrl+S). What you did with the mouse is saved by "
      "Ctrl+Shift+S instead. A name ending in " +
      std::string(STATE_EXTENSIONS) + " saves the cloth as it is now.");
  if (wideButton("Open a scene or a mesh ...")) context.requests.actions.push_back(ViewerAction::openFile);
  helpTip("A scene file, or an OBJ mesh (Ctrl+O). You can also drop one on the window.");
  ImGui::Separator();
  for (const std::string& file : files_)
    if (wideButton(file.c_str())) context.requests.openScene = "./" + file;
  drawCards(context);
}

}  // namespace clothsim
