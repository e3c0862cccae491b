// The panel Solver: where and how steps are computed, gravity, air, and how layers are kept apart.
#include <utility>

#include "cloth/material.h"
#include "scene_io/field_table.h"
#include "scene_io/solver_defaults.h"
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

void drawWind(PanelContext& context) {
  bool blows = context.draft.wind.has_value();
  if (ImGui::Checkbox("wind", &blows)) {
    context.draft.wind = blows ? std::optional(Wind{}) : std::nullopt;
    if (blows) context.draft.wind->velocity = firstWind;
    context.widgets.changed(Change::live);
  }
  for (const Field<Scene>& field : fieldsOf<Scene>())
    if (field.key == "wind") helpTip(helpOf(field, "wind"));
  if (!context.draft.wind) return;
  context.widgets.all(*context.draft.wind, "wind");
  context.widgets.all(context.draft.wind->gust, "wind.gust");
}

}  // namespace

void drawSolverPanel(PanelContext& context) {
  drawBackend(context);
  const Integrator before = context.draft.solver.integrator;
  context.widgets.some(context.draft.solver, "solver", {"integrator", "frames_per_sec", "simulation_steps"});
  const Integrator chosen = std::exchange(context.draft.solver.integrator, before);
  setIntegrator(context.draft, chosen);
  ImGui::Separator();
  context.widgets.some(context.draft.solver, "solver", {"strain_limit", "self_collision", "self_friction"});
  chooseCounts(context.draft);
  ImGui::Separator();
  context.widgets.some(context.draft, "", {"gravity", "air_resistance"});
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
