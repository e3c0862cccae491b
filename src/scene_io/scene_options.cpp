#include "scene_io/scene_options.h"

#include <algorithm>
#include <set>
#include <utility>

#include "cloth/material.h"
#include "cloth/mesh_shape.h"
#include "core/error.h"
#include "core/formatted.h"
#include "scene/cloth_name.h"
#include "scene_io/mesh_scene.h"
#include "scene_io/scene_io.h"

namespace clothsim {
namespace {

struct Setting {
  std::string text;  // key=value
  const char* flag;
};

// Those of cloths first: a cloth's model decides what the solver's defaults are.
std::vector<Setting> settingsInOrder(const SceneOptions& options) {
  std::vector<Setting> settings;
  for (const std::string& text : options.settings) settings.push_back({text, "--set"});
  for (const std::string& text : options.varied) settings.push_back({text, "--vary"});
  std::stable_partition(settings.begin(), settings.end(),
                        [](const Setting& setting) { return setting.text.starts_with("cloth"); });
  return settings;
}

// Whether the setting leaves --resolution nothing to say of steps.
bool setsSteps(const Setting& setting) {
  return setting.text.starts_with("solver.simulation_steps=") ||
         setting.text == "solver.integrator=implicit" || setting.text == "solver.integrator=bdf2" ||
         setting.text.find(".material=") != std::string::npos;
}

// What "auto" stands for in this scene; empty when nothing that counts is automatic.
std::string chosenCounts(const SolverSettings& solver) {
  constexpr double small = 5e-5;  // such steps take longer than a solve would in most scenes [s]
  std::string text;
  if (solver.simulationSteps.automatic) {
    text = formatted("solver.simulation_steps=%d, %s steps of %.3g s", solver.simulationSteps.count,
                     integratorName(solver.integrator), stepLength(solver));
    if (!isImplicit(solver.integrator) && stepLength(solver) < small)
      text += "; solver.integrator=implicit takes larger ones";
  }
  if (isImplicit(solver.integrator) && solver.cgIterations.automatic)
    text += (text.empty() ? "" : "; ") + formatted("solver.cg_iterations=%d", solver.cgIterations.count);
  return text.empty() ? "" : "auto chose " + text;
}

// Once for each mesh.
void addLoosePoints(RemarkedScene& read) {
  std::set<std::string> files;
  for (const ClothSettings& cloth : read.scene.cloths) {
    if (!cloth.isMesh() || !files.insert(cloth.mesh).second) continue;
    if (const std::size_t loose = meshShapeOf(cloth.mesh)->loosePoints; loose > 0)
      read.remarks.push_back(
          cloth.mesh + ": left out " + std::to_string(loose) +
          (loose == 1 ? " point that belongs to no face" : " points that belong to no face"));
  }
}

// Settings that are given and change nothing.
void addIdleSettings(RemarkedScene& read) {
  const SolverSettings& solver = read.scene.solver;
  for (std::size_t i = 0; i < read.scene.cloths.size(); ++i) {
    const ClothSettings& cloth = read.scene.cloths[i];
    if (!cloth.stiffnessReference && cloth.referenceLength != ClothSettings{}.referenceLength)
      read.remarks.push_back(nameOfCloth(read.scene, i) +
                             ".reference_length changes nothing without stiffness_reference");
  }
  if (solver.selfFriction && solver.selfCollision != SelfCollision::robust &&
      solver.selfCollision != SelfCollision::contact)
    read.remarks.push_back(std::string("solver.self_friction changes nothing where self_collision is ") +
                           selfCollisionName(solver.selfCollision) + "; robust and contact have friction");
}

}  // namespace

RemarkedScene readScene(const SceneOptions& options) {
  RemarkedScene read = changedScene(loadSceneByName(options.scene), options);
  if (isMeshFile(options.scene)) read.remarks.push_back(remarkOfMeshScene(read.scene));
  return read;
}

RemarkedScene changedScene(Scene from, const SceneOptions& options) {
  RemarkedScene read{std::move(from), {}};
  Scene& scene = read.scene;
  const std::vector<Setting> settings = settingsInOrder(options);
  if (options.resolution) {
    for (const Setting& setting : settings)
      if (setting.text.find("num_width_points=") != std::string::npos ||
          setting.text.find("num_height_points=") != std::string::npos)
        throw UsageError(std::string(setting.flag) + " " + setting.text +
                         ": expected no number of points beside --resolution, which sets both");
    const bool keepsSteps = std::any_of(settings.begin(), settings.end(), setsSteps);
    const std::string remark =
        changeResolution(scene, options.resolution->columns, options.resolution->rows, keepsSteps);
    if (!remark.empty()) read.remarks.push_back(remark);
  }
  for (const Setting& setting : settings) setSceneValue(scene, setting.text, setting.flag);
  addLoosePoints(read);
  addIdleSettings(read);
  if (const std::string chosen = chosenCounts(scene.solver); !chosen.empty()) read.remarks.push_back(chosen);
  if (usesMaterial(scene) && stepLength(scene.solver) > stableStep(scene) * (1 + 1e-9))
    read.remarks.push_back(
        formatted("steps of %.3g s may be too long for this material; steps up to %.3g s are guaranteed "
                  "stable: --set solver.simulation_steps=%d, or auto; or --set solver.integrator=implicit",
                  stepLength(scene.solver), stableStep(scene), stableSteps(scene)));
  return read;
}

}  // namespace clothsim
