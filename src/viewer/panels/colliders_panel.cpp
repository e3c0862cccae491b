// Colliders: the solid shapes, each with the fields of its type.
#include <type_traits>

#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr const char* typeNames[] = {"sphere", "plane", "capsule", "box", "torus", "mesh"};
static_assert(std::size(typeNames) == std::variant_size_v<Collider>);

// A new one, where the camera looks. A mesh needs a file that only a scene can name.
Collider newCollider(std::size_t type, Vec3d place) {
  Collider collider = type == 1   ? Collider(Plane{})
                      : type == 2 ? Collider(Capsule{})
                      : type == 3 ? Collider(Box{})
                      : type == 4 ? Collider(Torus{})
                                  : Collider(Sphere{});
  std::visit(
      [&](auto& shape) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(shape)>, Plane>)
          shape.point = place;
        else
          shape.origin = place;
      },
      collider);
  return collider;
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
  for (std::size_t type = 0; type < std::size(typeNames); ++type) {
    if (std::string_view(typeNames[type]) == "mesh") continue;
    if (!ImGui::Selectable(typeNames[type])) continue;
    context.draft.colliders.push_back(newCollider(type, context.lookedAt));
    context.widgets.changed(Change::live);
  }
  ImGui::EndCombo();
}

}  // namespace

void drawCollidersPanel(PanelContext& context) {
  context.widgets.some(context.draft.solver, "solver", {"friction_law"});
  std::vector<Collider>& colliders = context.draft.colliders;
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const std::string label = std::string(typeNames[colliders[i].index()]) + " " + std::to_string(i + 1);
    const bool open =
        ImGui::TreeNodeEx(label.c_str(), colliders.size() < 4 ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    bool removed = false;
    if (open) {
      drawFields(context, colliders[i], "colliders." + std::to_string(i));
      removed = ImGui::SmallButton("Remove");
      ImGui::TreePop();
    }
    ImGui::PopID();
    if (removed) {
      colliders.erase(colliders.begin() + static_cast<std::ptrdiff_t>(i));
      context.widgets.changed(Change::live);
      break;
    }
  }
  if (colliders.empty()) quietText("No colliders in this scene.");
  drawAddition(context);
}

}  // namespace clothsim
