#include "scene/obj_file.h"

#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/files.h"

namespace clothsim {

namespace fs = std::filesystem;

namespace {

std::string readMeshFile(const std::string& file, const std::string& use) {
  try {
    return readFile(meshPath(file), 256 * 1024 * 1024);
  } catch (const InputOutputError& error) {
    throw SceneError(std::string(error.what()) + "\nthe " + use +
                     " is looked for beside the scene file and in " + resourceRoot().string());
  }
}

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// "1 2.5 -3e2": whether the line begins with three numbers that binary32 can hold.
bool hasThreeNumbers(std::string_view line) {
  for (int i = 0; i < 3; ++i) {
    while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
    if (!line.empty() && line.front() == '+') line.remove_prefix(1);
    double number = 0;
    const auto [end, code] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (code != std::errc() || !std::isfinite(static_cast<float>(number))) return false;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  }
  return line.empty() || isBlank(line.front());
}

// tinyobjloader takes what is no number for 0.
void checkPoints(const std::string& file, std::string_view text) {
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
    while (!line.empty() && isBlank(line.back())) line.remove_suffix(1);
    if (line.size() < 2 || line[0] != 'v' || !isBlank(line[1]) || hasThreeNumbers(line.substr(1))) continue;
    throw SceneError(file + ":" + std::to_string(number) +
                     ": expected a point, v and three finite numbers, found \"" + std::string(line) + "\"");
  }
}

}  // namespace

fs::path meshPath(const std::string& file) {
  std::error_code ignored;  // the reader complains
  return fs::path(file).is_absolute() || fs::exists(file, ignored) ? fs::path(file) : resourceRoot() / file;
}

ObjFile readObjFile(const std::string& file, const std::string& use) {
  const std::string bytes = readMeshFile(file, use);
  checkPoints(file, bytes);
  std::istringstream text(bytes);
  ObjFile obj;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  const bool read =
      tinyobj::LoadObj(&obj.attributes, &obj.shapes, &materials, &warnings, &errors, &text, nullptr, true);
  if (!read) throw SceneError(file + ": cannot be read as an OBJ file: " + errors);
  // Of polygons with such a corner it leaves some triangles out.
  if (warnings.find("Vertex indices out of bounds") != std::string::npos ||
      warnings.find("invalid vertex index") != std::string::npos)
    throw SceneError(file + ": a face names a point that the file does not have, expected 1 to " +
                     std::to_string(obj.attributes.vertices.size() / 3));
  return obj;
}

}  // namespace clothsim
