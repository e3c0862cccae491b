// The panel Cloth: springs, material and size of each cloth.
#include "cloth/material.h"
#include "cloth/material_look.h"
#include "scene_io/solver_defaults.h"
#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

// Toggles for the three kinds of springs in a row, as in CS184's program.
void drawSpringKinds(PanelContext& context, ClothSettings& cloth, const std::string& path) {
  struct Kind {
    std::string_view key;
    const char* label;
    bool ClothSettings::*enabled;
  };
  const Kind kinds[] = {{"enable_structural", "structural", &ClothSettings::enableStructural},
                        {"enable_shearing", "shearing", &ClothSettings::enableShearing},
                        {"enable_bending", "bending", &ClothSettings::enableBending}};
  const float gap = 0.12f * em();
  const float width = cloth.isMesh() ? (ImGui::GetContentRegionAvail().x - gap) / 2
                                     : (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  for (const Kind& kind : kinds) {
    if (cloth.isMesh() && kind.enabled == &ClothSettings::enableShearing) continue;
    if (&kind != kinds) ImGui::SameLine(0, gap);
    if (toggleButton(kind.label, cloth.*kind.enabled, width)) context.widgets.changed(Change::rebuild);
    for (const Field<ClothSettings>& field : fieldsOf<ClothSettings>())
      if (field.key == kind.key) helpTip(helpOf(field, path));
  }
}

// A cloth that is given a material loses its spring constants, and the solver gets the defaults for
// materials. A cloth without a material gets CS184's spring constant back. Returns whether it was either: the
// strain of soft springs would tear a fabric to pieces.
bool chooseModel(Scene& scene, ClothSettings& cloth) {
  if (cloth.material && (cloth.ks || cloth.stiffnessReference)) {
    giveMaterial(cloth, Material{*cloth.material});
    const SolverSettings usual = solverDefaults(usesKs(scene), true);
    scene.solver.integrator = usual.integrator;
    scene.solver.simulationSteps = usual.simulationSteps;
    scene.solver.selfCollision = usual.selfCollision;
    return true;
  }
  if (cloth.material || cloth.ks || cloth.stiffnessReference) return false;
  cloth.ks = defaultKs;
  return true;
}

void drawCloth(PanelContext& context, ClothSettings& cloth, const std::string& path) {
  drawSpringKinds(context, cloth, path);
  const RenderSettings look = usualLook(context.draft);
  context.widgets.some(cloth, path, {"material"});
  if (chooseModel(context.draft, cloth)) context.requests.startsAnew = true;
  followLook(context.draft.render, look, usualLook(context.draft));
  if (cloth.material) {
    context.widgets.all(*cloth.material, path + ".material");
  } else {
    if (cloth.stiffnessReference)
      context.widgets.some(cloth, path, {"stiffness_reference", "reference_length"});
    else
      context.widgets.some(cloth, path, {"ks"});
    context.widgets.some(cloth, path, {cloth.mass ? "mass" : "density", "damping", "thickness"});
  }
  if (cloth.isMesh())
    context.widgets.some(cloth, path, {"scale"});
  else
    context.widgets.some(cloth, path, {"width", "height", "num_width_points", "num_height_points"});
}

}  // namespace

void drawClothPanel(PanelContext& context) {
  const bool several = context.draft.cloths.size() > 1;
  for (std::size_t i = 0; i < context.draft.cloths.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const std::string label = "cloth " + std::to_string(i + 1);
    if (!several) {
      drawCloth(context, context.draft.cloths[i], "cloth");
    } else if (ImGui::TreeNodeEx(label.c_str(), i == 0 ? ImGuiTreeNodeFlags_DefaultOpen : 0)) {
      drawCloth(context, context.draft.cloths[i], "cloths." + std::to_string(i));
      ImGui::TreePop();
    }
    ImGui::PopID();
  }
}

}  // namespace clothsim
