// Results as JSON on standard output.
#pragma once

#include <iostream>
#include <nlohmann/json.hpp>

namespace clothsim {

// File names may contain bytes that are not UTF-8. JSON cannot: they become the replacement character.
inline void printJson(const nlohmann::ordered_json& json) {
  std::cout << json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

}  // namespace clothsim
