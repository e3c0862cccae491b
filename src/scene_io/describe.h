// The table of scene keys (field_table.h) as text, for `clothsim describe`.
#pragma once

#include <string>
#include <vector>

namespace clothsim {

// One key as `clothsim describe` shows it.
struct FieldInfo {
  std::string path;   // "cloth.ks", "colliders[].friction", "solver.integrator"
  std::string type;   // "number", "integer", "boolean", "string", "one of verlet, euler", "[x, y, z]", ...
  std::string unit;   // "N/m", "" for none
  std::string range;  // ">= 0", "2 to 16384", "" for any
  std::string defaultValue;  // as JSON, or a few words where it depends on the scene
  std::string help;          // one line
  bool live = false;         // takes effect in the next step; otherwise the cloth is rebuilt
};
[[nodiscard]] std::vector<FieldInfo> describeFields();

}  // namespace clothsim
