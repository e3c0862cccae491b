// --set key=value: the scene is written to a tree, the tree is changed at the key, and read again with every
// check.
#include <algorithm>
#include <charconv>
#include <optional>

#include "cloth/material.h"
#include "core/error.h"
#include "core/nearest.h"
#include "scene_io/codec.h"
#include "scene_io/describe.h"
#include "scene_io/json_tree.h"
#include "scene_io/scene_io.h"
#include "scene_io/scene_tree.h"

namespace clothsim {

namespace {

using Steps = std::vector<std::string>;

Steps split(const std::string& path) {
  Steps steps(1);
  for (const char c : path) {
    if (c == '.')
      steps.emplace_back();
    else
      steps.back() += c;
  }
  return steps;
}

// The text as JSON if it is that, else as a string.
JsonPointer parseValue(const std::string& text) {
  try {
    return parseJson(text);
  } catch (const JsonComplaint&) {
    // It is written and parsed, since a bare word must be valid UTF-8 like any other string.
    return parseJson(formatJsonLine(*makeString(text)));
  }
}

void forgetLines(JsonNode& node) {
  node.line = 0;
  for (const auto& child : node.children) forgetLines(*child);
}

// The index of the first collider of that type, or the number of colliders if there is none.
std::size_t firstCollider(const JsonNode& colliders, const std::string& type) {
  const auto at = std::find_if(colliders.children.begin(), colliders.children.end(),
                               [&](const auto& collider) { return collider->find("type")->text == type; });
  return static_cast<std::size_t>(at - colliders.children.begin());
}

// "cloth" to "cloths.0", "sphere" to the first sphere of "colliders". `sphere={...}` adds one where there is
// none.
Steps resolveAliases(Steps steps, JsonNode& root, JsonNode& value) {
  if (steps.front() == "cloth") {
    steps.front() = "cloths";
    steps.insert(steps.begin() + 1, "0");
  } else if (steps.front() == "sphere" || steps.front() == "plane") {
    const std::string type = steps.front();
    JsonNode* colliders = root.find("colliders");
    if (colliders == nullptr) colliders = &root.append("colliders", makeList());
    const std::size_t place = firstCollider(*colliders, type);
    if (place == colliders->children.size()) {
      if (steps.size() > 1 || value.kind == JsonKind::null) {
        throw JsonComplaint(0, 0, "", "the scene has no " + type + "; add one with --set '" + type + "={}'");
      }
      colliders->append("", makeObject());
    }
    if (steps.size() == 1 && value.kind == JsonKind::object && value.find("type") == nullptr)
      value.append("type", makeString(type));
    steps.front() = "colliders";
    steps.insert(steps.begin() + 1, std::to_string(place));
  }
  return steps;
}

std::size_t listPlace(const JsonNode& list, const std::string& step) {
  std::size_t place = 0;
  const auto [end, code] = std::from_chars(step.data(), step.data() + step.size(), place);
  const std::size_t size = list.children.size();
  if (code != std::errc() || end != step.data() + step.size() || place >= size)
    complain(list,
             "expected the number of an entry, " +
                 (size == 0 ? std::string("but the list is empty") : "0 to " + std::to_string(size - 1)) +
                 ", found \"" + step + "\"");
  return place;
}

void replace(JsonNode& parent, const std::string& step, JsonPointer value) {
  if (parent.kind == JsonKind::list) {
    JsonPointer& child = parent.children[listPlace(parent, step)];
    value->parent = &parent;
    child = std::move(value);
    return;
  }
  std::erase_if(parent.children, [&](const auto& child) { return child->key == step; });
  parent.append(step, std::move(value));
}

// `null` takes a key back to its default, or an entry out of its list.
void erase(JsonNode& parent, const std::string& step) {
  if (parent.kind == JsonKind::list)
    parent.children.erase(parent.children.begin() + static_cast<std::ptrdiff_t>(listPlace(parent, step)));
  else
    std::erase_if(parent.children, [&](const auto& child) { return child->key == step; });
}

bool isPlace(const std::string& step) { return step.find_first_not_of("0123456789") == std::string::npos; }

// "colliders.0.origin" as the table of fields has it: "colliders[].origin".
std::string tablePath(const Steps& steps, std::size_t count) {
  std::string path;
  for (std::size_t i = 0; i < count; ++i) path += isPlace(steps[i]) ? "[]" : (i == 0 ? "" : ".") + steps[i];
  const std::string cloths = "cloths[]";
  return path.starts_with(cloths) ? "cloth" + path.substr(cloths.size()) : path;
}

// The default of a list that the writer left out. Null if the key has none.
JsonPointer defaultList(const std::string& path) {
  for (const FieldInfo& field : describeFields())
    if (field.path == path && field.defaultValue.starts_with('[')) return parseJson(field.defaultValue);
  return nullptr;
}

// Goes down by steps[i], making the list or object there if the writer had left it out.
JsonNode& descend(JsonNode& node, const Steps& steps, std::size_t i) {
  const std::string& step = steps[i];
  if (node.kind == JsonKind::list) return *node.children[listPlace(node, step)];
  if (node.kind != JsonKind::object) complainExpected(node, "an object that has the key \"" + step + "\"");
  if (JsonNode* child = node.find(step)) return *child;
  JsonNode& child = node.append(step, makeObject());
  if (!isPlace(steps[i + 1])) return child;
  JsonPointer list = defaultList(tablePath(steps, i + 1));
  if (list == nullptr) complain(child, "has no entries to change; set the whole of it");
  forgetLines(*list);
  child.kind = JsonKind::list;
  for (JsonPointer& entry : list->children) child.append("", std::move(entry));
  return child;
}

void setAt(JsonNode& root, const Steps& steps, JsonPointer value) {
  // Readers of files pass over comments, but to set one is a change without effect.
  for (const std::string& step : steps)
    if (step.empty() || isComment(step))
      throw JsonComplaint(0, 0, "", "\"" + step + "\" is not a key that can be set");
  JsonNode* node = &root;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) node = &descend(*node, steps, i);
  if (node->kind != JsonKind::list && node->kind != JsonKind::object)
    complainExpected(*node, "an object that has the key \"" + steps.back() + "\"");
  if (value->kind == JsonKind::null)
    erase(*node, steps.back());
  else
    replace(*node, steps.back(), std::move(value));
}

// Where a cloth is given a material, or a part of one, the keys that a material replaces are removed. A
// preset of which a part changes is spelled out.
void leaveToMaterial(JsonNode& root, const Steps& steps) {
  const auto material = std::find(steps.begin(), steps.end(), "material");
  if (material == steps.end()) return;
  JsonNode* cloth = &root;
  for (std::size_t i = 0; &steps[i] != &*material; ++i) cloth = &descend(*cloth, steps, i);
  for (const char* key : {"ks", "stiffness_reference", "density", "mass", "damping", "thickness"})
    erase(*cloth, key);
  const JsonNode* named = cloth->find("material");
  if (named != nullptr && named->kind == JsonKind::string && material + 1 != steps.end())
    replace(*cloth, "material", spelledOut(*materialPreset(named->text)));
}

// Of density and mass the one that is set stays.
void leaveOneMass(JsonNode& root, const Steps& steps, const JsonNode& value) {
  if (steps.size() != 3 || steps[0] != "cloths" || value.kind == JsonKind::null) return;
  if (steps[2] == "density" || steps[2] == "mass")
    erase(descend(descend(root, steps, 0), steps, 1), steps[2] == "density" ? "mass" : "density");
}

// What was chosen for springs does not suit a material: with the first one integrator, steps and the kind of
// self-collision return to their defaults. Where cloth was to pass through itself it still does.
void leaveSolverToMaterial(JsonNode& root) {
  JsonNode* solver = root.find("solver");
  if (solver == nullptr) return;
  for (const char* key : {"integrator", "simulation_steps"}) erase(*solver, key);
  const JsonNode* selfCollision = solver->find("self_collision");
  if (selfCollision != nullptr && selfCollision->kind == JsonKind::string) erase(*solver, "self_collision");
}

// Where a cloth becomes a mesh, the keys of a grid are removed.
void leaveToMesh(JsonNode& root, const Steps& steps, const JsonNode& value) {
  if (steps.size() != 3 || steps.back() != "mesh" || value.kind != JsonKind::string) return;
  JsonNode& cloth = descend(descend(root, steps, 0), steps, 1);
  if (cloth.find("mesh") != nullptr) return;
  for (const char* key : {"width", "height", "num_width_points", "num_height_points", "orientation",
                          "enable_shearing", "pinned", "pin_motion"})
    erase(cloth, key);
}

// Messages name the key as it was typed, not "cloths.0".
std::string asTyped(std::string path, const Steps& typed, const Steps& resolved) {
  if (typed.size() == resolved.size()) return path;
  const std::string prefix = resolved[0] + "." + resolved[1];
  if (path == prefix || path.starts_with(prefix + ".")) path.replace(0, prefix.size(), typed[0]);
  return path;
}

}  // namespace

void setSceneValue(Scene& scene, const std::string& keyEqualsValue, const std::string& flag) {
  const std::size_t equals = keyEqualsValue.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(flag + " " + keyEqualsValue + ": expected key=value, such as cloth.damping=0.5");
  const Steps typed = split(keyEqualsValue.substr(0, equals));
  Steps resolved = typed;
  try {
    JsonPointer value = parseValue(keyEqualsValue.substr(equals + 1));
    forgetLines(*value);
    const JsonPointer root = writeScene(scene);
    resolved = resolveAliases(typed, *root, *value);
    leaveToMaterial(*root, resolved);
    leaveToMesh(*root, resolved, *value);
    leaveOneMass(*root, resolved, *value);
    setAt(*root, resolved, std::move(value));
    Scene changed = readScene(*root);
    if (usesMaterial(changed) && !usesMaterial(scene)) {
      leaveSolverToMaterial(*root);
      changed = readScene(*root);
    }
    scene = std::move(changed);
  } catch (const JsonComplaint& complaint) {
    const std::string path = asTyped(complaint.path, typed, resolved);
    throw SceneError(flag + " " + keyEqualsValue + ": " + (path.empty() ? "" : path + ": ") +
                     complaint.what());
  }
}

}  // namespace clothsim
