// The panel Look: the shading model, colours and other keys of `render`, of the scene or of one cloth or
// collider, and what is drawn over the cloth.
#include "cloth/material_look.h"
#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

// The controls show how the cloth looks now; what is changed becomes its own.
void drawClothLook(PanelContext& context, std::size_t number) {
  ClothLook& own = context.draft.cloths[number].render;
  const RenderSettings before = lookOf(context.draft, number);
  RenderSettings look = before;
  context.widgets.some(look, "cloths." + std::to_string(number) + ".render",
                       {"color", "back_color", "texture", "texture_repeat", "weave", "thread_spacing",
                        "gloss", "fuzz", "normal_strength", "height", "thickness"});
  forEachOfLook([&](auto member, auto ofScene) {
    if (look.*ofScene != before.*ofScene) own.*member = look.*ofScene;
  });
  if (own != ClothLook{} && ImGui::SmallButton("As the scene and its material have it")) {
    own = {};
    context.widgets.changed(Change::live);
  }
}

void drawSolidLook(PanelContext& context, std::size_t number) {
  std::visit(
      [&](auto& shape) {
        context.widgets.all(shape.render, "colliders." + std::to_string(number) + ".render");
      },
      context.draft.colliders[number]);
}

// Which look the controls are for: 0 the scene's, then those of cloths, then those of colliders.
std::size_t chooseLook(const Scene& scene) {
  std::vector<std::string> names{"the scene"};
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) names.push_back("cloth " + std::to_string(i + 1));
  for (std::size_t i = 0; i < scene.colliders.size(); ++i)
    names.push_back(std::string(typeOf(scene.colliders[i])) + " " + std::to_string(i + 1));
  int* const kept = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("look of"), 0);
  auto chosen = static_cast<std::size_t>(*kept);
  if (chosen >= names.size()) chosen = 0;
  quietText("look of");
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::BeginCombo("##look of", names[chosen].c_str())) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (ImGui::Selectable(names[i].c_str(), i == chosen)) chosen = i;
    ImGui::EndCombo();
  }
  helpTip("The scene's look holds for all cloths; a cloth or a collider may have one of its own.");
  *kept = static_cast<int>(chosen);
  return chosen;
}

}  // namespace

void drawLookPanel(PanelContext& context) {
  quietText("quality of the picture");
  constexpr const char* qualities[] = {"draft", "normal", "final"};
  const int quality = static_cast<int>(context.quality);
  const int chosen = segmentedButtons("quality", qualities, 3, quality);
  helpTip(
      "draft: on a software renderer the scene is drawn in as few pixels as a smooth frame rate needs, "
      "with coarser shadows. normal: in fewer pixels only below 30 frames/s. final: as render draws it. A "
      "setting "
      "of the viewer, not of the scene (Q).");
  if (chosen != quality) context.requests.quality = static_cast<Quality>(chosen);
  ImGui::Separator();
  const std::size_t number = chooseLook(context.draft), cloths = context.draft.cloths.size();
  if (number == 0)
    context.widgets.all(context.draft.render, "render");
  else if (number <= cloths)
    drawClothLook(context, number - 1);
  else
    drawSolidLook(context, number - 1 - cloths);
  ImGui::Separator();
  quietText("also draw");
  const char* const kinds[] = {"structural springs", "shear springs", "bending springs"};
  for (std::size_t i = 0; i < std::size(kinds); ++i) {
    ImGui::Checkbox(kinds[i], &context.view.showSprings[i]);
    helpTip("Draws these springs as lines over the cloth. A setting of the viewer, not of the scene.");
  }
  ImGui::Checkbox("pins", &context.view.showPins);
  helpTip("Marks the pinned particles. A setting of the viewer, not of the scene.");
}

}  // namespace clothsim
