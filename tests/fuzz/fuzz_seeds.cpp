// Writes seeds for the fuzzers and their dictionary, from the program's own tables, so that they keep up with
// it: fuzz_seeds FOLDER
#include <filesystem>

#include "core/files.h"
#include "export/formats.h"
#include "scene_io/describe.h"
#include "scene_io/scene_io.h"
#include "session/recording.h"

using namespace clothsim;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& path, std::string_view bytes) {
  fs::create_directories(path.parent_path());
  writeFileAtomically(path, bytes);
}

State makeState(std::size_t particles, Integrator integrator) {
  State state;
  state.integrator = integrator;
  for (std::size_t i = 0; i < particles; ++i) {
    state.positions.push_back({static_cast<float>(i), 0.5f, -1e-3f, i == 0 ? 0.0f : 25.0f});
    state.velocities.push_back({0, static_cast<float>(i), 1.0f / 3.0f, 0});
  }
  return state;
}

void writeStates(const fs::path& folder) {
  write(folder / "verlet.state", formatStateFile(makeState(6, Integrator::verlet)));
  write(folder / "euler.state", formatStateFile(makeState(2, Integrator::euler)));
  State handled = makeState(4, Integrator::verlet);
  handled.cuts = {0, 1, 63, 0};
  handled.offPath = {1, 3};
  write(folder / "handled.state", formatStateFile(handled));
  State rubbed = makeState(3, Integrator::euler);
  rubbed.elasticSlips.assign(3, {1e-5f, 0, 0, 0.5f});
  rubbed.pairSlips = {{1, {0, 1, 2, 0}, 0, 1e-5f, 0, 0.5f}};
  write(folder / "rubbed.state", formatStateFile(rubbed));
  State swinging = makeState(2, Integrator::euler);
  swinging.histories.assign(4, {0, 1e-3f, 0, 0});
  swinging.usualSteps = 2;
  write(folder / "swinging.state", formatStateFile(swinging));
}

// One event of every kind.
void writeRecording(const fs::path& path) {
  Scene scene;
  scene.cloths[0].ks = 5000;
  Recording recording;
  recording.scene = scene;
  recording.frames = 20;
  const Action actions[] = {EditScene{recording.scene},
                            Grab{.particle = 3, .target = {1, 2, 3}, .radius = 0.1},
                            MoveHand{{0, 1, 0}},
                            Release{},
                            SetPin{.particle = 7, .pinned = false},
                            CutStroke{.piece = 0, .from = {0.5, 1}, .to = {9, 12.25}},
                            Blow{.origin = {0, 1, 0}, .direction = {1, 0, 0}, .speed = 5},
                            MoveCollider{.collider = 0, .position = {0, 0, 1}},
                            TurnCollider{.collider = 0, .turn = {0, 30, 0}},
                            SwitchBackend{"cpu"},
                            Restart{}};
  static_assert(std::size(actions) == std::variant_size_v<Action>);
  for (const Action& action : actions) recording.events.push_back({10 * recording.events.size(), action});
  write(path, recording.format());
}

// "colliders[].friction" as "colliders.0.friction".
std::string firstOf(std::string path) {
  for (std::size_t at; (at = path.find("[]")) != std::string::npos;) path.replace(at, 2, ".0");
  return path;
}

// Every key with its default, and with values of every kind.
void writeFlags(const fs::path& folder) {
  std::string flags;
  int count = 0, file = 0;
  const auto flush = [&] {
    write(folder / ("keys_" + std::to_string(file++)), flags);
    flags.clear();
    count = 0;
  };
  const char* values[] = {"null", "0.5", "true", "[1, 2, 3]", "\"word\"", "-0", "3"};
  std::size_t next = 0;
  for (const FieldInfo& field : describeFields()) {
    flags += firstOf(field.path) + "=" + values[next++ % std::size(values)] + "\n";
    if (++count == 4) flush();  // as many as the harness takes
  }
  flush();
}

void writeDictionary(const fs::path& path) {
  std::string words;
  for (const char* word : {"true", "false", "null", "1e-20", "1e15", "2147483648", "-0", "NaN", "\\\\u0000",
                           "\\xef\\xbb\\xbf", "\\x1b[31m", "\\\"type\\\":", "\\\"t\\\":"})
    words += '"' + std::string(word) + "\"\n";
  for (const FieldInfo& field : describeFields()) {
    const std::string key = field.path.substr(field.path.find_last_of('.') + 1);
    words += "\"\\\"" + key + "\\\":\"\n\"" + firstOf(field.path) + "=\"\n";
  }
  write(path, words);
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const fs::path folder = words[1];
  writeStates(folder / "state");
  writeRecording(folder / "recording" / "every_action.json");
  writeFlags(folder / "set");
  writeDictionary(folder / "keys.dict");
}
