// The panel Colliders: a list of shapes with the fields of their types.
#include <algorithm>
#include <utility>

#include "scene/field.h"
#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

// Whether the type has a required key, as the file of a mesh.
bool needsFile(const Collider& collider) {
  return std::visit(
      [](const auto& shape) {
        const auto fields = shape.fields();
        return std::any_of(fields.begin(), fields.end(),
                           [](const FieldTraits& field) { return field.presence == Presence::required; });
      },
      collider);
}

void drawFields(PanelContext& context, Collider& collider, const std::string& path) {
  std::visit(
      [&](auto& shape) {
        context.widgets.all(shape, path);
        if (shape.motion)
          quietText("moves along a path of " + std::to_string(shape.motion->keys.size()) + " keys");
      },
      collider);
}

void drawAddition(PanelContext& context) {
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ImGui::BeginCombo("##add", "Add a collider")) return;
  for (Collider& collider : defaultColliders()) {
    if (needsFile(collider) || !ImGui::Selectable(typeOf(collider).data())) continue;
    placeOf(collider) = context.lookedAt;
    context.draft.colliders.push_back(collider);
    context.widgets.changed(Change::live);
  }
  ImGui::EndCombo();
}

// Pins that move with it stay where they start; those of colliders behind it follow these to their new
// numbers.
void removeCollider(Scene& scene, std::size_t number) {
  scene.colliders.erase(scene.colliders.begin() + static_cast<std::ptrdiff_t>(number));
  for (ClothSettings& cloth : scene.cloths)
    for (PinMotion& motion : cloth.pinMotion) {
      if (motion.collider == static_cast<int>(number)) {
        motion.collider = NO_BODY;
        motion.keys = {PinMotion::Key{}};
      } else if (motion.collider > static_cast<int>(number)) {
        --motion.collider;
      }
    }
}

}  // namespace

void drawCollidersPanel(PanelContext& context) {
  context.widgets.some(context.draft.solver, "solver", {"friction_law"});
  std::vector<Collider>& colliders = context.draft.colliders;
  int* const shown = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("chosen solid"), -1);
  const int chosen = context.chosenSolid ? static_cast<int>(*context.chosenSolid) : -1;
  const bool isNew = std::exchange(*shown, chosen) != chosen;
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const std::string label = std::string(typeOf(colliders[i])) + " " + std::to_string(i + 1);
    const bool isChosen = context.chosenSolid == i;
    if (isChosen && isNew) {  // chosen in the picture: shown here, too
      ImGui::SetNextItemOpen(true);
      ImGui::SetScrollHereY(0.1f);
    }
    ImGui::PushStyleColor(ImGuiCol_Header, theme::fill);
    const bool open = ImGui::TreeNodeEx(
        label.c_str(), (colliders.size() < 4 ? ImGuiTreeNodeFlags_DefaultOpen : 0) |
                           (isChosen ? ImGuiTreeNodeFlags_Selected : 0) | ImGuiTreeNodeFlags_SpanAvailWidth);
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(0)) context.requests.chooseSolid = i;  // as it opens
    helpTip(
        "Opens it, and gives it the handles in the picture (G). A click on it in the picture opens it here.");
    bool removed = false;
    if (open) {
      drawFields(context, colliders[i], "colliders." + std::to_string(i));
      removed = ImGui::SmallButton("Remove");
      ImGui::TreePop();
    }
    ImGui::PopID();
    if (removed) {
      removeCollider(context.draft, i);
      context.widgets.changed(Change::live);
      break;
    }
  }
  if (colliders.empty()) quietText("No colliders in this scene.");
  drawAddition(context);
}

}  // namespace clothsim
