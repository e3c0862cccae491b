// The table of scene keys (field_table.h) as text, for `clothsim describe`.
#pragma once

#include <string>
#include <string_view>
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

// The keys of a collider of this type, as "sphere.radius"; none where there is no such type.
[[nodiscard]] std::vector<FieldInfo> describeShape(std::string_view type);

// All keys as a page in Markdown, a table for each group: docs/scene-format.md.
[[nodiscard]] std::string fieldsAsMarkdown();

}  // namespace clothsim
