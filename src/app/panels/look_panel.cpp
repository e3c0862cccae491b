// Look: shading model, colours and everything else that render.* says, and what is drawn on top.
#include "app/panels/panels.h"
#include "app/ui_frame.h"

namespace clothsim {

void drawLookPanel(PanelContext& context) {
  context.widgets.all(context.draft.render, "render");
  ImGui::Separator();
  quietText("draw as well");
  const char* const kinds[] = {"structural springs", "shearing springs", "bending springs"};
  for (std::size_t i = 0; i < std::size(kinds); ++i) {
    ImGui::Checkbox(kinds[i], &context.view.showSprings[i]);
    helpTip(
        "Draws the springs of this kind as lines over the cloth. Belongs to the viewer, not to the scene.");
  }
  ImGui::Checkbox("pins", &context.view.showPins);
  helpTip("Marks the particles that are pinned. Belongs to the viewer, not to the scene.");
}

}  // namespace clothsim
