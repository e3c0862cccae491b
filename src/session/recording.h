// All actions on a simulation since its start. `clothsim run --replay FILE` applies them again and gets the
// same bits on either backend.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/shared.h"
#include "scene/scene.h"
#include "session/actions.h"

namespace clothsim {

struct Recording {
  struct Event {
    std::uint64_t step = 0;  // number of steps before it, counted over all restarts
    Action action;
  };

  Shared<Scene> scene;          // at the start
  std::string backend = "gpu";  // at the start
  int frames = 0;               // simulated so far
  std::vector<Event> events;    // in the order in which they were applied
  std::string source;           // the file that it was loaded from, for messages; "" for none

  // As JSON, in the format "clothsim-recording/1".
  [[nodiscard]] std::string format() const;
  // `source` names the text in messages. @throws SceneError with line and JSON path when the text is not a
  // recording
  [[nodiscard]] static Recording parse(std::string_view text, const std::string& source);

  // Writes format() whole or not at all. @throws InputOutputError
  void save(const std::filesystem::path& path) const;
  // Parses a file. Mesh files that lie beside it get their full path. @throws SceneError
  [[nodiscard]] static Recording load(const std::filesystem::path& path);

  // Does `work` for an event. What is wrong there becomes a SceneError that names the file and the event.
  void within(std::size_t event, const std::function<void()>& work) const;
};

}  // namespace clothsim
