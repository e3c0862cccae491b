// JSON as a tree that remembers keys in order and the line of every value, so that a wrong scene can be
// reported with its place. Libraries' own trees keep neither lines nor duplicate keys. For src/scene_io, and
// for readers of files that hold scenes among other things.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec.h"

namespace clothsim {

enum class JsonKind { null, boolean, number, string, list, object };

struct JsonNode {
  JsonKind kind = JsonKind::null;
  bool boolean = false;
  double number = 0;
  std::string text;  // the content of a string, or a number as it was spelled
  std::string key;   // its name in the object that it is a member of
  int line = 0;      // from 1; 0: it does not come from a file
  JsonNode* parent = nullptr;
  std::vector<std::unique_ptr<JsonNode>> children;

  // The member of that key, or null.
  [[nodiscard]] const JsonNode* find(std::string_view name) const;
  [[nodiscard]] JsonNode* find(std::string_view name);
  // Appends and returns the child.
  JsonNode& append(std::string name, std::unique_ptr<JsonNode> child);
};
using JsonPointer = std::unique_ptr<JsonNode>;

[[nodiscard]] JsonPointer makeBoolean(bool value);
[[nodiscard]] JsonPointer makeNumber(double value);
[[nodiscard]] JsonPointer makeString(std::string_view value);
[[nodiscard]] JsonPointer makeList();
[[nodiscard]] JsonPointer makeObject();
[[nodiscard]] JsonPointer makeVector(Vec3d value);

// Something wrong with a value. parseScene and setSceneValue turn it into a SceneError with the name of the
// source.
struct JsonComplaint : std::runtime_error {
  JsonComplaint(int line_, int column_, std::string path_, const std::string& message)
      : std::runtime_error(message), line(line_), column(column_), path(std::move(path_)) {}
  int line, column;  // 0: unknown
  std::string path;
};

// "cloth.json:12: cloth.ks: expected ..."; with a column only where the syntax is wrong.
[[nodiscard]] std::string located(const std::string& source, const JsonComplaint& complaint);

// Throws the complaint about `node`: "cloth.ks: <message>" with its line.
[[noreturn]] void complain(const JsonNode& node, const std::string& message);
// "expected <what>, found <the value>"
[[noreturn]] void complainExpected(const JsonNode& node, const std::string& what);

// "cloth.pinned.0.1", as --set takes it; empty for the root.
[[nodiscard]] std::string pathOf(const JsonNode& node);
// The value for a message: `"stiff"`, `50.5`, `a list of 3`, `an object`.
[[nodiscard]] std::string foundText(const JsonNode& node);
// Whether a key is a comment for people, which readers pass over: "comment", or one that begins with "//".
[[nodiscard]] bool isComment(std::string_view key);

inline constexpr std::size_t MOST_SCENE_VALUES = 1'000'000;  // in the JSON of a scene

// `what`: is expected in place of an empty file.
// @throws JsonComplaint: wrong syntax, duplicate keys, invalid UTF-8, more than 64 levels or `mostValues`
[[nodiscard]] JsonPointer parseJson(std::string_view text, std::size_t mostValues = MOST_SCENE_VALUES,
                                    const std::string& what = "a scene");

// Two spaces a level; a list or object that fits is kept on one line. Numbers in the fewest digits that read
// back exactly.
[[nodiscard]] std::string formatJson(const JsonNode& root);
// The same on one line.
[[nodiscard]] std::string formatJsonLine(const JsonNode& node);
[[nodiscard]] std::string formatNumber(double value);

}  // namespace clothsim
