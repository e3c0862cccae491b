// The panel Simulation: the controls of CS184's program, and more.
#include "cloth/material.h"
#include "viewer/panels/panels.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr Vec3d firstWind{0, 0, -3};  // when wind is switched on [m/s]

void drawBackend(PanelContext& context) {
  const char* const names[] = {"GPU", "CPU"};
  const int now = context.backend == "gpu" ? 0 : 1;
  const int chosen = segmentedButtons("backend", names, 2, now);
  helpTip("Where the cloth is computed. Switching continues from the bit-identical state (B).");
  if (chosen != now) context.requests.backend = chosen == 0 ? "gpu" : "cpu";
  if (wideButton("Compare GPU and CPU from here"))
    context.requests.actions.push_back(ViewerAction::compareBackends);
  helpTip("Runs both from this state and counts the numbers that differ (C).");
}

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
// materials. A cloth without a material gets CS184's spring constant back.
void chooseModel(Scene& scene, ClothSettings& cloth) {
  if (cloth.material && (cloth.ks || cloth.stiffnessReference)) {
    giveMaterial(cloth, Material{*cloth.material});
    const SolverSettings usual = solverDefaults(usesKs(scene), true);
    scene.solver.integrator = usual.integrator;
    scene.solver.simulationSteps = usual.simulationSteps;
  }
  if (!cloth.material && !cloth.ks && !cloth.stiffnessReference) cloth.ks = defaultKs;
}

void drawCloth(PanelContext& context, ClothSettings& cloth, const std::string& path) {
  drawSpringKinds(context, cloth, path);
  context.widgets.some(cloth, path, {"material"});
  chooseModel(context.draft, cloth);
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

void drawWind(PanelContext& context) {
  bool blows = context.draft.wind.has_value();
  if (ImGui::Checkbox("wind", &blows)) {
    context.draft.wind = blows ? std::optional(Wind{}) : std::nullopt;
    if (blows) context.draft.wind->velocity = firstWind;
    context.widgets.changed(Change::live);
  }
  helpTip(
      "Air that moves past the cloth; without it no wind forces are computed.\n\nwind\nTakes effect "
      "immediately.");
  if (!context.draft.wind) return;
  context.widgets.all(*context.draft.wind, "wind");
  context.widgets.all(context.draft.wind->gust, "wind.gust");
}

}  // namespace

void drawSimulationPanel(PanelContext& context) {
  drawBackend(context);
  context.widgets.some(context.draft.solver, "solver", {"integrator", "frames_per_sec", "simulation_steps"});
  context.widgets.some(context.draft, "", {"gravity", "air_resistance"});
  ImGui::Separator();
  for (std::size_t i = 0; i < context.draft.cloths.size(); ++i) {
    const bool several = context.draft.cloths.size() > 1;
    const std::string path = several ? "cloths." + std::to_string(i) : "cloth";
    ImGui::PushID(static_cast<int>(i));
    const std::string label = "cloth " + std::to_string(i + 1);
    if (!several) {
      drawCloth(context, context.draft.cloths[i], path);
    } else if (ImGui::TreeNodeEx(label.c_str(), i == 0 ? ImGuiTreeNodeFlags_DefaultOpen : 0)) {
      drawCloth(context, context.draft.cloths[i], path);
      ImGui::TreePop();
    }
    ImGui::PopID();
  }
  ImGui::Separator();
  context.widgets.some(context.draft.solver, "solver", {"strain_limit", "self_collision", "self_friction"});
  chooseCounts(context.draft);
  ImGui::Separator();
  drawWind(context);
  ImGui::Separator();
  // All other settings of the solver: a new key appears here automatically.
  if (ImGui::TreeNode("more")) {
    context.widgets.all(context.draft.solver, "solver",
                        {"integrator", "frames_per_sec", "simulation_steps", "strain_limit", "self_collision",
                         "self_friction", "friction_law"});
    ImGui::TreePop();
  }
}

}  // namespace clothsim
