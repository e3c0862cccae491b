// The panel Look: the shading model, colours and other keys of `render`, and what is drawn over the cloth.
#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {

void drawLookPanel(PanelContext& context) {
  quietText("quality of the picture");
  constexpr const char* qualities[] = {"draft", "normal", "final"};
  const int quality = static_cast<int>(context.quality);
  const int chosen = segmentedButtons("quality", qualities, 3, quality);
  helpTip(
      "draft: on a software renderer the scene is drawn in as few pixels as a fluent picture needs, with "
      "coarser shadows. normal: in fewer pixels only below 30 frames/s. final: as render draws it. A setting "
      "of the viewer, not of the scene (Q).");
  if (chosen != quality) context.requests.quality = static_cast<Quality>(chosen);
  ImGui::Separator();
  context.widgets.all(context.draft.render, "render");
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
