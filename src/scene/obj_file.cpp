#include "scene/obj_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
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

constexpr std::size_t MOST_CORNERS = 1000;  // of a face: cutting it into triangles takes their square

// A line of the file, for messages.
class Line {
 public:
  Line(const std::string& file, std::size_t number, std::string_view text)
      : file_(file), number_(number), text_(text) {}
  [[noreturn]] void failExpecting(const std::string& what) const {
    const std::string quote(text_.substr(0, 80));
    throw SceneError(file_ + ":" + std::to_string(number_) + ": expected " + what + ", found \"" + quote +
                     (quote.size() < text_.size() ? "...\"" : "\""));
  }

 private:
  const std::string& file_;
  std::size_t number_;
  std::string_view text_;
};

// Refuses numbers so large that tinyobjloader would wrap them around. `corners`: "1 2/3 -4//5".
void checkFace(const Line& line, std::string_view corners) {
  std::size_t count = 0;
  while (!corners.empty()) {
    if (isBlank(corners.front()) || corners.front() == '/') {
      corners.remove_prefix(1);
      continue;
    }
    const std::size_t end = std::min(corners.find_first_of(" \t\r"), corners.size());
    if (++count > MOST_CORNERS)
      line.failExpecting("a face of at most " + std::to_string(MOST_CORNERS) + " corners");
    std::string_view corner = corners.substr(0, end);
    while (!corner.empty()) {
      int index = 0;
      const auto [next, code] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
      if (code == std::errc::result_out_of_range)
        line.failExpecting("numbers of points of at most " + std::to_string(std::numeric_limits<int>::max()));
      const std::size_t slash = corner.find('/');
      corner.remove_prefix(slash == corner.npos ? corner.size() : slash + 1);
    }
    corners.remove_prefix(end);
  }
}

// The lines that a cloth or a collider needs, checked: tinyobjloader reads what is no number as 0, and for
// some other lines allocates as much memory as they ask for.
std::string checkedLines(const std::string& file, std::string_view text) {
  std::string kept;
  kept.reserve(text.size() + 1);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
    while (!line.empty() && isBlank(line.back())) line.remove_suffix(1);
    const std::string_view word = line.substr(0, std::min(line.find_first_of(" \t"), line.size()));
    if (word == "v" && !hasThreeNumbers(line.substr(1)))
      Line(file, number, line).failExpecting("a point, v and three finite numbers");
    if (word == "f") checkFace(Line(file, number, line), line.substr(1));
    const std::string_view needed[] = {"v", "vt", "vn", "f", "g", "o"};
    if (std::find(std::begin(needed), std::end(needed), word) != std::end(needed)) kept.append(line);
    kept += '\n';  // so that tinyobjloader counts lines as the file has them
  }
  return kept;
}

}  // namespace

fs::path meshPath(const std::string& file) {
  std::error_code ignored;  // Reading the file will report it.
  return fs::path(file).is_absolute() || fs::exists(file, ignored) ? fs::path(file) : resourceRoot() / file;
}

ObjFile readObjFile(const std::string& file, const std::string& use) {
  std::istringstream text(checkedLines(file, readMeshFile(file, use)));
  ObjFile obj;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  const bool read = tinyobj::LoadObj(&obj.attributes, &obj.shapes, &materials, &warnings, &errors, &text,
                                     nullptr, true, false);
  if (!read) throw SceneError(file + ": cannot be read as an OBJ file: " + errors);
  // tinyobjloader leaves out triangles of polygons with such a corner.
  if (warnings.find("Vertex indices out of bounds") != std::string::npos ||
      warnings.find("invalid vertex index") != std::string::npos)
    throw SceneError(file + ": a face names a point that the file does not have, expected 1 to " +
                     std::to_string(obj.attributes.vertices.size() / 3));
  return obj;
}

}  // namespace clothsim
