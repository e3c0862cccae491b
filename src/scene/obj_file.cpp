#include "scene/obj_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "scene/polygon.h"

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
  [[noreturn]] void failExpecting(const std::string& what) const { fail("expected " + what); }
  [[noreturn]] void fail(const std::string& what) const {
    const std::string quote(text_.substr(0, 80));
    throw SceneError(file_ + ":" + std::to_string(number_) + ": " + what + ", found \"" + quote +
                     (quote.size() < text_.size() ? "...\"" : "\""));
  }

 private:
  const std::string& file_;
  std::size_t number_;
  std::string_view text_;
};

struct Face {
  int highest = 0;  // number of a point at a corner
  std::size_t line = 0;
  std::string text;
};

// How many corners it has, and the highest number of a point there. Refuses numbers so large that
// tinyobjloader would wrap them around. `corners`: "1 2/3 -4//5".
std::pair<std::size_t, int> checkedFace(const Line& line, std::string_view corners) {
  std::size_t count = 0;
  int highest = 0;
  while (!corners.empty()) {
    if (isBlank(corners.front()) || corners.front() == '/') {
      corners.remove_prefix(1);
      continue;
    }
    const std::size_t end = std::min(corners.find_first_of(" \t\r"), corners.size());
    if (++count > MOST_CORNERS)
      line.failExpecting("a face of at most " + std::to_string(MOST_CORNERS) + " corners");
    std::string_view corner = corners.substr(0, end);
    bool isPoint = true;  // before the first slash
    while (!corner.empty()) {
      int index = 0;
      const auto [next, code] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
      if (code == std::errc::result_out_of_range)
        line.failExpecting("numbers of points of at most " + std::to_string(std::numeric_limits<int>::max()));
      if (std::exchange(isPoint, false)) highest = std::max(highest, index);
      const std::size_t slash = corner.find('/');
      corner.remove_prefix(slash == corner.npos ? corner.size() : slash + 1);
    }
    corners.remove_prefix(end);
  }
  return {count, highest};
}

// The lines that a cloth or a collider needs, checked: tinyobjloader reads what is no number as 0, and for
// some other lines allocates as much memory as they ask for. It counts corners of faces to 255, then from 0
// on.
struct CheckedLines {
  std::string text;
  std::vector<std::size_t> corners;  // of each face
  std::size_t points = 0;
  Face farthest;  // that names the highest number of a point
};

// A line without its end, and how many lines of the file it is: one that ends with a backslash goes on.
std::size_t takeLine(std::string_view& text, std::string& line) {
  line.clear();
  bool hasComment = false;
  for (std::size_t count = 1;; ++count) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view part = text.substr(0, end);
    line.append(part);
    hasComment = hasComment || part.find('#') != part.npos;
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && isBlank(line.back())) line.pop_back();
    if (text.empty() || !line.ends_with('\\') || hasComment) return count;
    line.back() = ' ';
  }
}

CheckedLines checkedLines(const std::string& file, std::string_view text) {
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
  CheckedLines kept;
  kept.text.reserve(text.size() + 1);
  std::string whole;
  for (std::size_t number = 1, lines = 0; !text.empty(); number += lines) {
    lines = takeLine(text, whole);
    std::string_view line = whole;
    while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
    if (line.starts_with('v') || line.starts_with('f')) line = line.substr(0, line.find('#'));
    while (!line.empty() && isBlank(line.back())) line.remove_suffix(1);
    const std::string_view word = line.substr(0, std::min(line.find_first_of(" \t"), line.size()));
    if (word == "v" && !hasThreeNumbers(line.substr(1)))
      Line(file, number, line).failExpecting("a point, v and three finite numbers");
    if (word == "v") ++kept.points;
    if (word == "f") {
      const auto [corners, highest] = checkedFace(Line(file, number, line), line.substr(1));
      if (corners >= 3) kept.corners.push_back(corners);  // tinyobjloader leaves out others
      if (corners >= 3 && highest > kept.farthest.highest)
        kept.farthest = {highest, number, std::string(line)};
    }
    const std::string_view needed[] = {"v", "vt", "vn", "f", "g", "o"};
    if (std::find(std::begin(needed), std::end(needed), word) != std::end(needed)) kept.text.append(line);
    kept.text.append(lines, '\n');  // so that tinyobjloader counts lines as the file has them
  }
  return kept;
}

// tinyobjloader itself covers a hollow polygon more than once, and one with corners along its sides with
// triangles of no area. `faces`: corners of each face; gets shorter by those of this mesh. False where
// tinyobjloader has counted otherwise.
[[nodiscard]] bool splitIntoTriangles(tinyobj::mesh_t& mesh, const std::vector<tinyobj::real_t>& points,
                                      std::span<const std::size_t>& faces) {
  std::vector<tinyobj::index_t> corners;
  std::vector<Vec3d> polygon;
  for (std::size_t first = 0; first < mesh.indices.size();
       first += polygon.size(), faces = faces.subspan(1)) {
    if (faces.empty() || first + faces[0] > mesh.indices.size()) return false;
    polygon.clear();
    for (std::size_t k = 0; k < faces[0]; ++k) {
      const tinyobj::real_t* point =
          points.data() + 3 * static_cast<std::size_t>(mesh.indices[first + k].vertex_index);
      polygon.push_back({point[0], point[1], point[2]});
    }
    for (const auto& triangle : trianglesOf(polygon))
      for (const std::size_t corner : triangle) corners.push_back(mesh.indices[first + corner]);
  }
  mesh.indices = std::move(corners);
  mesh.num_face_vertices.assign(mesh.indices.size() / 3, 3);
  return true;
}

}  // namespace

fs::path meshPath(const std::string& file) {
  std::error_code ignored;  // Reading the file will report it.
  return fs::path(file).is_absolute() || fs::exists(file, ignored) ? fs::path(file) : resourceRoot() / file;
}

ObjFile readObjFile(const std::string& file, const std::string& use) {
  const CheckedLines lines = checkedLines(file, readMeshFile(file, use));
  const std::string noSuchPoint =
      "a face names a point that the file does not have, expected 1 to " + std::to_string(lines.points);
  if (static_cast<std::size_t>(lines.farthest.highest) > lines.points)
    Line(file, lines.farthest.line, lines.farthest.text).fail(noSuchPoint);
  std::istringstream text(lines.text);
  ObjFile obj;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  const bool read = tinyobj::LoadObj(&obj.attributes, &obj.shapes, &materials, &warnings, &errors, &text,
                                     nullptr, false, false);
  while (!errors.empty() && errors.back() == '\n') errors.pop_back();
  if (!read) throw SceneError(file + ": cannot be read as an OBJ file: " + errors);
  const auto points = static_cast<int>(obj.attributes.vertices.size() / 3);
  const auto hasNoPoint = [&](const tinyobj::index_t& corner) {
    return corner.vertex_index < 0 || corner.vertex_index >= points;
  };
  if (std::ranges::any_of(obj.shapes, [&](const tinyobj::shape_t& shape) {
        return std::ranges::any_of(shape.mesh.indices, hasNoPoint);
      }))
    throw SceneError(file + ": " + noSuchPoint);
  std::span<const std::size_t> faces(lines.corners);
  const bool areSplit = std::ranges::all_of(obj.shapes, [&](tinyobj::shape_t& shape) {
    return splitIntoTriangles(shape.mesh, obj.attributes.vertices, faces);
  });
  if (!areSplit || !faces.empty())
    throw SceneError(file + ": a face makes no sense, expected f and its corners, as f 1 2 3");
  return obj;
}

}  // namespace clothsim
