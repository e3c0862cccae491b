// What was done to a simulation, from its start on: enough to do it again with the same bits on either
// backend
// (`clothsim run --replay FILE`).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/shared.h"
#include "scene/scene.h"
#include "session/actions.h"

namespace clothsim {

struct Recording {
  struct Event {
    std::uint64_t step = 0;  // steps done before it, over all restarts
    Action action;
  };

  Shared<Scene> scene;          // as at the start
  std::string backend = "gpu";  // at the start
  int frames = 0;               // done so far
  std::vector<Event> events;    // in the order in which they acted
  std::string source;           // the file that it was loaded from, for messages; "" for none

  // JSON ("clothsim-recording/1")
  [[nodiscard]] std::string format() const;
  // `source` names the text in messages. @throws SceneError for a text that is no recording, with its line
  // and JSON path
  [[nodiscard]] static Recording parse(std::string_view text, const std::string& source);

  // Writes format() whole or not at all. @throws InputOutputError
  void save(const std::filesystem::path& path) const;
  // Parses a file. Mesh files that lie beside it get their full path. @throws SceneError
  [[nodiscard]] static Recording load(const std::filesystem::path& path);
};

}  // namespace clothsim
