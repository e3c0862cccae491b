// Recordings as JSON. The fields of each action are listed once, for writing and for reading.
#include "session/recording.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "cloth/material.h"
#include "core/error.h"
#include "core/files.h"
#include "core/nearest.h"
#include "scene_io/scene_io.h"
#include "scene_io/scene_tree.h"

namespace clothsim {
namespace {

constexpr std::string_view SCHEMA = "clothsim-recording/1";
constexpr std::uintmax_t LARGEST_FILE = std::uintmax_t{256} << 20;
constexpr std::size_t MOST_VALUES = 20'000'000;  // more than a recording of that size has

// The fields of every action. `io(key, value)` writes or reads one of them.
template <class Io>
void fields(Io& io, EditScene& action) {
  io("scene", action.scene);
}
template <class Io>
void fields(Io& io, Grab& action) {
  io("particle", action.particle);
  io("target", action.target);
  io("strength", action.strength);
  io("radius", action.radius);
}
template <class Io>
void fields(Io& io, MoveHand& action) {
  io("target", action.target);
}
template <class Io>
void fields(Io&, Release&) {}
template <class Io>
void fields(Io& io, SetPin& action) {
  io("particle", action.particle);
  io("pinned", action.pinned);
}
template <class Io>
void fields(Io& io, CutStroke& action) {
  io("cloth", action.piece);
  io("from", action.from);
  io("to", action.to);
}
template <class Io>
void fields(Io& io, Blow& action) {
  io("origin", action.origin);
  io("direction", action.direction);
  io("speed", action.speed);
  io("radius", action.radius);
}
template <class Io>
void fields(Io& io, MoveCollider& action) {
  io("collider", action.collider);
  io("position", action.position);
}
template <class Io>
void fields(Io& io, TurnCollider& action) {
  io("collider", action.collider);
  io("turn", action.turn);
}
template <class Io>
void fields(Io& io, SwitchBackend& action) {
  io("backend", action.backend);
}
template <class Io>
void fields(Io&, Restart&) {}

// In the order of the variant Action.
constexpr std::string_view actionNames[] = {
    "edit_scene", "grab",          "move_hand",     "release",        "set_pin", "cut",
    "blow",       "move_collider", "turn_collider", "switch_backend", "restart"};
static_assert(std::size(actionNames) == std::variant_size_v<Action>);

class Writer {
 public:
  explicit Writer(JsonNode& object) : object_(object) {}

  void operator()(const char* key, const Shared<Scene>& scene) {
    object_.append(key, parseJson(formatScene(*scene)));
  }
  void operator()(const char* key, Vec3d value) { object_.append(key, makeVector(value)); }
  void operator()(const char* key, double value) { object_.append(key, makeNumber(value)); }
  void operator()(const char* key, std::uint32_t value) { object_.append(key, makeNumber(value)); }
  void operator()(const char* key, std::uint64_t value) {
    object_.append(key, makeNumber(static_cast<double>(value)));
  }
  void operator()(const char* key, bool value) { object_.append(key, makeBoolean(value)); }
  void operator()(const char* key, const std::string& value) { object_.append(key, makeString(value)); }
  void operator()(const char* key, LatticePoint value) {
    JsonNode& list = object_.append(key, makeList());
    list.append("", makeNumber(value.column));
    list.append("", makeNumber(value.row));
  }

 private:
  JsonNode& object_;
};

// Reads the fields of an object. finish() complains about keys that were not read.
class Reader {
 public:
  explicit Reader(JsonNode& object) : object_(object) {
    if (object.kind != JsonKind::object) complainExpected(object, "an object");
  }

  // A member that must be there. @throws JsonComplaint
  JsonNode& member(const std::string& key) {
    known_.push_back(key);
    JsonNode* found = object_.find(key);
    if (found == nullptr) complain(object_, "the key \"" + key + "\" is missing");
    return *found;
  }

  void operator()(const char* key, Shared<Scene>& scene) {
    JsonNode& node = member(key);
    gatherLists(node);
    scene = readScene(node);
  }
  void operator()(const char* key, Vec3d& value) {
    const auto& numbers = list(member(key), 3, "[x, y, z]");
    value = {number(*numbers[0]), number(*numbers[1]), number(*numbers[2])};
  }
  void operator()(const char* key, LatticePoint& value) {
    const auto& numbers = list(member(key), 2, "[column, row]");
    value = {number(*numbers[0]), number(*numbers[1])};
  }
  void operator()(const char* key, double& value) { value = number(member(key)); }
  void operator()(const char* key, std::uint32_t& value) {
    value = static_cast<std::uint32_t>(count(member(key), std::numeric_limits<std::uint32_t>::max()));
  }
  void operator()(const char* key, std::uint64_t& value) { value = count(member(key), 9007199254740992.0); }
  void operator()(const char* key, int& value) {
    value = static_cast<int>(count(member(key), std::numeric_limits<int>::max()));
  }
  void operator()(const char* key, bool& value) {
    const JsonNode& node = member(key);
    if (node.kind != JsonKind::boolean) complainExpected(node, "true or false");
    value = node.boolean;
  }
  void operator()(const char* key, std::string& value) {
    const JsonNode& node = member(key);
    if (node.kind != JsonKind::string) complainExpected(node, "a string");
    value = node.text;
  }

  void finish() const {
    for (const auto& child : object_.children) {
      if (isComment(child->key)) continue;
      if (std::find(known_.begin(), known_.end(), child->key) == known_.end())
        complain(*child, "unknown key" + didYouMean(child->key, known_));
    }
  }

 private:
  static double number(const JsonNode& node) {
    if (node.kind != JsonKind::number) complainExpected(node, "a number");
    return node.number;
  }
  static std::uint64_t count(const JsonNode& node, double most) {
    const double value = number(node);
    if (!(value >= 0 && value <= most) || value != std::floor(value))
      complainExpected(node, "a whole number from 0 to " + formatNumber(most));
    return static_cast<std::uint64_t>(value);
  }
  static const std::vector<JsonPointer>& list(const JsonNode& node, std::size_t size, const char* what) {
    if (node.kind != JsonKind::list || node.children.size() != size) complainExpected(node, what);
    return node.children;
  }

  JsonNode& object_;
  std::vector<std::string> known_;
};

JsonPointer written(const Recording::Event& event) {
  JsonPointer object = makeObject();
  Writer writer(*object);
  writer("step", event.step);
  writer("action", std::string(actionNames[event.action.index()]));
  Action action = event.action;
  std::visit([&](auto& fieldsOf) { fields(writer, fieldsOf); }, action);
  return object;
}

template <std::size_t... indices>
Action actionOf(std::size_t wanted, std::index_sequence<indices...>) {
  Action action;
  (void)((indices == wanted && (action.emplace<indices>(), true)) || ...);
  return action;
}

Recording::Event readEvent(JsonNode& node, std::uint64_t earliestStep) {
  Reader reader(node);
  Recording::Event event;
  reader("step", event.step);
  if (event.step < earliestStep)
    complainExpected(*node.find("step"),
                     "at least " + std::to_string(earliestStep) + ", as in the event before");
  std::string name;
  reader("action", name);
  const std::vector<std::string> names(std::begin(actionNames), std::end(actionNames));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    complain(*node.find("action"),
             "unknown action " + foundText(*node.find("action")) + didYouMean(name, names));
  event.action = actionOf(static_cast<std::size_t>(found - names.begin()),
                          std::make_index_sequence<std::variant_size_v<Action>>());
  std::visit([&](auto& action) { fields(reader, action); }, event.action);
  reader.finish();
  return event;
}

Recording readRecording(JsonNode& root) {
  Reader reader(root);
  std::string schema;
  reader("schema", schema);
  if (schema == Scene{}.schema)
    complain(*root.find("schema"), "expected a recording, found a scene; -f takes it, without --replay");
  if (schema != SCHEMA) complainExpected(*root.find("schema"), "\"" + std::string(SCHEMA) + "\"");
  Recording recording;
  reader("backend", recording.backend);
  if (recording.backend != "cpu" && recording.backend != "gpu")
    complainExpected(*root.find("backend"), "\"cpu\" or \"gpu\"");
  reader("frames", recording.frames);
  reader("scene", recording.scene);
  JsonNode& events = reader.member("events");
  if (events.kind != JsonKind::list) complainExpected(events, "a list of events");
  for (const JsonPointer& event : events.children)
    recording.events.push_back(
        readEvent(*event, recording.events.empty() ? 0 : recording.events.back().step));
  reader.finish();
  return recording;
}

}  // namespace

std::string Recording::format() const {
  JsonPointer root = makeObject();
  Writer writer(*root);
  writer("schema", std::string(SCHEMA));
  writer("backend", backend);
  writer("frames", static_cast<std::uint32_t>(frames));
  writer("scene", scene);
  JsonNode& list = root->append("events", makeList());
  for (const Event& event : events) list.append("", written(event));
  return formatJson(*root);
}

Recording Recording::parse(std::string_view text, const std::string& source) {
  try {
    const JsonPointer root = parseJson(text, MOST_VALUES, "a recording");
    Recording recording = readRecording(*root);
    recording.source = source;
    return recording;
  } catch (const JsonComplaint& complaint) {
    throw SceneError(located(source, complaint));
  }
}

void Recording::save(const std::filesystem::path& path) const { writeFileAtomically(path, format()); }

void Recording::within(std::size_t event, const std::function<void()>& work) const {
  const auto fail = [&](const Error& error) {
    throw SceneError(source + ": events." + std::to_string(event) + ": " + error.what());
  };
  try {
    work();
  } catch (const UsageError& error) {
    fail(error);
  } catch (const SceneError& error) {
    fail(error);
  }
}

Recording Recording::load(const std::filesystem::path& path) {
  try {
    Recording recording = parse(readFile(path, LARGEST_FILE), path.string());
    const auto findMeshesOf = [&](Shared<Scene>& shared) {
      Scene found = *shared;
      findMeshes(found, path);
      chooseCounts(found);  // once more, since the counts of a mesh follow from its file
      shared = std::move(found);
    };
    findMeshesOf(recording.scene);
    for (std::size_t i = 0; i < recording.events.size(); ++i)
      if (auto* edit = std::get_if<EditScene>(&recording.events[i].action))
        recording.within(i, [&] { findMeshesOf(edit->scene); });
    return recording;
  } catch (const InputOutputError& error) {
    throw SceneError(error.what());
  }
}

}  // namespace clothsim
