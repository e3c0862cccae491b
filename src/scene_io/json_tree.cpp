// Building, naming and printing JSON trees.
#include "scene_io/json_tree.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "core/utf8.h"

namespace clothsim {

namespace {

JsonPointer makeNode(JsonKind kind) {
  auto node = std::make_unique<JsonNode>();
  node->kind = kind;
  return node;
}

std::string inQuotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      result += c == '\n' ? "\\n" : c == '\t' ? "\\t" : escape;
    } else {
      result += c;
    }
  }
  return result + '"';
}

// At most `limit` bytes, cut between characters of UTF-8.
std::string shortened(const std::string& text, std::size_t limit) {
  if (text.size() <= limit) return text;
  std::size_t end = limit;
  while (end > 0 && continuesCharacter(text[end])) --end;
  return text.substr(0, end) + "...";
}

std::string scalarText(const JsonNode& node) {
  switch (node.kind) {
    case JsonKind::boolean:
      return node.boolean ? "true" : "false";
    case JsonKind::number:
      return formatNumber(node.number);
    case JsonKind::string:
      return inQuotes(node.text);
    default:
      return "null";
  }
}

constexpr std::size_t lineWidth = 100;

void print(const JsonNode& node, std::size_t indent, bool alwaysOpen, std::string& out) {
  const std::string line = formatJsonLine(node);
  const std::size_t before = indent + node.key.size();
  if (!alwaysOpen && before + line.size() <= lineWidth) {
    out += line;
    return;
  }
  const bool isObject = node.kind == JsonKind::object;
  if (node.children.empty()) {
    out += line;
    return;
  }
  out += isObject ? "{\n" : "[\n";
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    const JsonNode& child = *node.children[i];
    out += std::string(indent + 2, ' ');
    if (isObject) out += inQuotes(child.key) + ": ";
    print(child, indent + 2, false, out);
    out += i + 1 < node.children.size() ? ",\n" : "\n";
  }
  out += std::string(indent, ' ') + (isObject ? "}" : "]");
}

}  // namespace

const JsonNode* JsonNode::find(std::string_view name) const {
  const auto at =
      std::find_if(children.begin(), children.end(), [&](const auto& child) { return child->key == name; });
  return kind == JsonKind::object && at != children.end() ? at->get() : nullptr;
}

JsonNode* JsonNode::find(std::string_view name) {
  return const_cast<JsonNode*>(static_cast<const JsonNode*>(this)->find(name));
}

JsonNode& JsonNode::append(std::string name, std::unique_ptr<JsonNode> child) {
  child->key = std::move(name);
  child->parent = this;
  children.push_back(std::move(child));
  return *children.back();
}

JsonPointer makeBoolean(bool value) {
  JsonPointer node = makeNode(JsonKind::boolean);
  node->boolean = value;
  return node;
}

JsonPointer makeNumber(double value) {
  JsonPointer node = makeNode(JsonKind::number);
  node->number = value;
  node->text = formatNumber(value);
  return node;
}

JsonPointer makeString(std::string_view value) {
  JsonPointer node = makeNode(JsonKind::string);
  node->text = value;
  return node;
}

JsonPointer makeList() { return makeNode(JsonKind::list); }
JsonPointer makeObject() { return makeNode(JsonKind::object); }

JsonPointer makeVector(Vec3d value) {
  JsonPointer list = makeList();
  for (const double component : {value.x, value.y, value.z}) list->append("", makeNumber(component));
  return list;
}

std::string pathOf(const JsonNode& node) {
  std::string path;
  for (const JsonNode* at = &node; at->parent != nullptr; at = at->parent) {
    std::string step = at->key;
    if (at->parent->kind == JsonKind::list) {
      const auto& siblings = at->parent->children;
      const auto place = std::find_if(siblings.begin(), siblings.end(),
                                      [&](const auto& child) { return child.get() == at; });
      step = std::to_string(place - siblings.begin());
    }
    path = path.empty() ? step : step + "." + path;
  }
  return path;
}

std::string located(const std::string& source, const JsonComplaint& complaint) {
  std::string text = source;
  for (const int place : {complaint.line, complaint.column})
    if (place > 0) text.append(":").append(std::to_string(place));
  if (!complaint.path.empty()) text.append(": ").append(complaint.path);
  return text.append(": ").append(complaint.what());
}

void complain(const JsonNode& node, const std::string& message) {
  throw JsonComplaint(node.line, 0, shortened(pathOf(node), 120), message);
}

void complainExpected(const JsonNode& node, const std::string& what) {
  complain(node, "expected " + what + ", found " + foundText(node));
}

std::string foundText(const JsonNode& node) {
  switch (node.kind) {
    case JsonKind::string:
      return inQuotes(shortened(node.text, 60));
    case JsonKind::number:
      return shortened(node.text, 60);
    case JsonKind::list:
      return node.children.size() == 1 ? "a list of 1 value"
                                       : "a list of " + std::to_string(node.children.size()) + " values";
    case JsonKind::object:
      return "an object";
    default:
      return scalarText(node);
  }
}

bool isComment(std::string_view key) { return key == "comment" || key.starts_with("//"); }

std::string formatNumber(double value) {
  char text[32];
  // 100000 reads better than the shorter 1e+05.
  const bool plain = std::abs(value) < 1e9 && value == std::floor(value);
  const auto [end, code] = plain ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed)
                                 : std::to_chars(text, text + sizeof text, value);
  return code == std::errc() ? std::string(text, end) : "null";
}

std::string formatJsonLine(const JsonNode& node) {
  const bool isObject = node.kind == JsonKind::object;
  if (!isObject && node.kind != JsonKind::list) return scalarText(node);
  std::string line(1, isObject ? '{' : '[');
  for (const auto& child : node.children) {
    if (line.size() > 1) line += ", ";
    if (isObject) line += inQuotes(child->key) + ": ";
    line += formatJsonLine(*child);
  }
  return line + (isObject ? '}' : ']');
}

std::string formatJson(const JsonNode& root) {
  std::string text;
  print(root, 0, true, text);
  return text + "\n";
}

}  // namespace clothsim
