// `scenes` lists the scenes, `describe` explains their keys, `doctor` checks this machine.
#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>

#include "commands/commands.h"
#include "commands/print_json.h"
#include "commands/proposal.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/thread_team.h"
#include "core/vector_set.h"
#include "gl/context.h"
#include "scene_io/describe.h"
#include "scene_io/scene_io.h"
#include "simulation/compare.h"
#include "simulation/gpu/solvers.h"
#include "solver/step_list.h"

namespace clothsim {
namespace {

void printField(const FieldInfo& field) {
  std::string facts = field.type;
  if (!field.unit.empty()) facts += " [" + field.unit + "]";
  if (!field.range.empty()) facts += ", " + field.range;
  if (!field.defaultValue.empty()) facts += ", default " + field.defaultValue;
  std::printf("%s\n    %s%s\n    %s\n", field.path.c_str(), facts.c_str(), field.live ? ", live" : "",
              field.help.c_str());
}

// The scenes of the self-test. Together they use every pass.
std::vector<Scene> selfTestScenes() {
  std::vector<Scene> scenes;
  for (const char* name : {"pinned2", "sphere", "plane", "cs171", "demo"}) {
    scenes.push_back(loadSceneByName(name));
    scenes.back().name = name;
    (void)changeResolution(scenes.back(), 40, 40, false);
  }
  return scenes;
}

}  // namespace

int scenesCommand() {
  for (const BundledScene& scene : bundledScenes())
    std::printf("%-16s %s\n", scene.name.c_str(), scene.description.c_str());
  return 0;
}

int describeCommand(const std::string& typed) {
  // Also as --set and messages write them: cloths.0.ks, colliders.1.radius, cloth.pinned.0.
  std::string key = std::regex_replace(typed, std::regex("^cloths\\.[0-9]+"), "cloth");
  key = std::regex_replace(key, std::regex("\\.[0-9]+$"), "");
  key = std::regex_replace(key, std::regex("\\.[0-9]+\\."), "[].");
  std::vector<FieldInfo> fields = describeFields();
  if (key.empty()) {
    for (const FieldInfo& field : fields) printField(field);
    return 0;
  }
  // "sphere", "capsule.radius": the keys of that shape alone.
  const std::vector<FieldInfo> ofShape = describeShape(key.substr(0, key.find('.')));
  fields.insert(fields.end(), ofShape.begin(), ofShape.end());
  bool found = false;
  std::vector<std::string> paths;
  for (const FieldInfo& field : fields) {
    paths.push_back(field.path);
    const bool inside = field.path.starts_with(key + ".") || field.path.starts_with(key + "[]");
    const bool last = field.path.ends_with("." + key);
    if (field.path != key && !inside && !last) continue;
    printField(field);
    found = true;
  }
  if (!found)
    throw UsageError("there is no scene key \"" + key + "\"" + didYouMean(key, paths) +
                     "; `clothsim describe` lists all");
  return 0;
}

int describeMarkdownCommand() {
  std::printf("%s", fieldsAsMarkdown().c_str());
  return 0;
}

int describeStepCommand(const SceneOptions& options) {
  const Scene scene = loadScene(options);
  const Cloth cloth(scene);
  std::printf("%s", describe(makeStep(scene, cloth, mostLevels(cloth, {}))).c_str());
  return 0;
}

int doctorCommand(bool json) {
  const gl::HeadlessContext context;
  const gl::ContextInfo& info = context.info();
  nlohmann::ordered_json report = nlohmann::ordered_json::object();
  report["vendor"] = info.vendor;
  report["renderer"] = info.renderer;
  report["version"] = info.version;
  report["software"] = info.software;
  report["max_storage_block_mib"] = info.maxStorageBlockBytes >> 20;
  report["max_work_group_invocations"] = info.maxWorkGroupInvocations;
  report["max_work_group_count"] = info.maxWorkGroupCountX;
  report["threads"] = ThreadTeam::shared().threads();
  report["vectors"] = nameOf(vectorSet());
  bool healthy = true;
  for (const Scene& scene : selfTestScenes()) {
    const Comparison result = compareBackends(scene, 5, makeSolver);
    healthy = healthy && result.differingFloats == 0 && result.finite;
    report["self_test"][scene.name] = {{"steps", result.steps}, {"differing_floats", result.differingFloats}};
  }
  report["bitwise_equal"] = healthy;
  const Proposal proposal = measureProposal(true);
  const std::string size = resolutionOf(proposal),
                    fault = keepProposal(proposal, proposalPath(), machineName());
  report["proposal"] = {{"backend", proposal.backend},
                        {"resolution", size},
                        {"quality", nameOf(proposal.quality)},
                        {"simulation_seconds", proposal.simulationSeconds},
                        {"draw_seconds", proposal.drawSeconds}};
  if (json) {
    printJson(report);
    return healthy ? 0 : 1;
  }
  std::printf("OpenGL         %s\n               %s, %s\n", info.renderer.c_str(), info.version.c_str(),
              info.vendor.c_str());
  std::printf(
      "limits         storage blocks of %lld MiB, work groups of %d invocations, %d groups a dispatch\n",
      info.maxStorageBlockBytes >> 20, info.maxWorkGroupInvocations, info.maxWorkGroupCountX);
  std::printf("processor      %d threads, vectors of %s\n", report["threads"].get<int>(),
              report["vectors"].get<std::string>().c_str());
  for (const auto& [name, result] : report["self_test"].items())
    std::printf("self-test      %-10s %4d steps on CPU and GPU: %d floats differ\n", name.c_str(),
                result["steps"].get<int>(), result["differing_floats"].get<int>());
  std::printf(
      "proposal       %s backend, %s points, %s quality: of the demo's start, %.1f ms for 1/30 s and %.1f ms "
      "for a\n               picture of 1280 x 720; %s\n",
      proposal.backend.c_str(), size.c_str(), std::string(nameOf(proposal.quality)).c_str(),
      1e3 * proposal.simulationSeconds, 1e3 * proposal.drawSeconds,
      fault.empty() ? "tools/demo and --resolution auto take it" : ("not kept: " + fault).c_str());
  std::printf("%s\n",
              healthy
                  ? "All is well: CPU and GPU agree in every bit."
                  : "This driver does not keep to the numeric contract: CPU and GPU differ. Trust the CPU.");
  return healthy ? 0 : 1;
}

}  // namespace clothsim
