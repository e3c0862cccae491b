// The object `crossings` that `run --json` and `compare --json` print.
#pragma once

#include <nlohmann/json.hpp>

#include "measure/crossings.h"

namespace clothsim {

[[nodiscard]] inline nlohmann::ordered_json toJson(const CrossingSummary& crossings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["frames_checked"] = crossings.framesChecked;
  json["worst"] = crossings.worst;
  json["total"] = crossings.total;
  json["first_frame"] = crossings.firstFrame ? nlohmann::ordered_json(*crossings.firstFrame) : nullptr;
  json["neighbours"] = crossings.neighbours;
  return json;
}

}  // namespace clothsim
