// Includes point one way. The table below is that rule; the tests hold every file in
// src/ to it.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/files.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

struct Room {
  std::set<std::string> mayInclude;  // rooms of src/, apart from itself
  std::set<std::string> outside;     // libraries that not every room may include
};

// A room is a folder below src/. The innermost folder named here is the one that a file belongs to.
const std::map<std::string, Room> rooms{
    {"core", {{}, {}}},
    {"scene", {{"core"}, {"tinyobj"}}},
    {"cloth", {{"core", "scene"}, {}}},
    {"scene_io", {{"core", "scene", "cloth"}, {"rapidjson"}}},
    {"solver", {{"core", "scene", "cloth"}, {}}},
    {"solver/cpu", {{"core", "scene", "cloth", "solver"}, {"omp"}}},
    {"gl", {{"core"}, {"opengl"}}},
    {"solver/gpu", {{"core", "scene", "cloth", "solver", "gl"}, {"opengl"}}},
    {"render", {{"core", "scene", "cloth", "gl"}, {"opengl", "glm", "stb"}}},
    {"export", {{"core", "scene", "cloth", "solver"}, {"stb"}}},
    {"measure", {{"core", "scene", "cloth", "solver", "solver/cpu"}, {"cgal", "nlohmann"}}},
    {"simulation",
     {{"core", "scene", "cloth", "scene_io", "solver", "solver/cpu", "export", "measure"}, {"nlohmann"}}},
    {"session", {{"core", "scene", "cloth", "scene_io", "solver", "simulation"}, {"nlohmann"}}},
    {"simulation/gpu",
     {{"core", "scene", "cloth", "solver", "solver/gpu", "gl", "render", "simulation"}, {"opengl"}}},
    {"output", {{"core", "scene", "render", "export"}, {"stb"}}},
    {"viewer",
     {{"core", "scene", "cloth", "scene_io", "solver", "solver/gpu", "gl", "render", "export", "measure",
       "simulation", "simulation/gpu", "session", "output"},
      {"glfw", "imgui", "nlohmann", "glm"}}},
    {"python",
     {{"core", "scene", "cloth", "scene_io", "solver", "solver/cpu", "gl", "render", "export", "simulation",
       "simulation/gpu", "session"},
      {"nlohmann", "pybind11"}}},
    {"commands",
     {{"core", "scene", "cloth", "scene_io", "solver", "solver/cpu", "solver/gpu", "gl", "render", "export",
       "measure", "simulation", "simulation/gpu", "session", "output", "viewer"},
      {"cli", "nlohmann", "omp"}}},
};

// The libraries whose place matters, by how their headers begin. Everybody may include the standard library
// and POSIX.
const std::vector<std::pair<std::string, std::string>> libraries{
    {"GLFW/", "glfw"},
    {"imgui", "imgui"},
    {"backends/imgui", "imgui"},
    {"glad/", "opengl"},
    {"EGL/", "opengl"},
    {"GL/", "opengl"},
    {"GLES", "opengl"},
    {"gl/api.h", "opengl"},
    {"glm/", "glm"},
    {"nlohmann/", "nlohmann"},
    {"rapidjson/", "rapidjson"},
    {"CLI/", "cli"},
    {"stb", "stb"},
    {"omp.h", "omp"},
    {"CGAL/", "cgal"},
    {"tiny_obj", "tinyobj"},
    {"pybind11/", "pybind11"},
};

// The longest room that begins the path: "solver/gpu" for "solver/gpu/gpu_solver.h", "" when there is none.
std::string roomOf(const std::string& path) {
  std::string found;
  for (const auto& [name, room] : rooms)
    if (path.starts_with(name + "/") && name.size() > found.size()) found = name;
  return found;
}

std::string libraryOf(const std::string& header) {
  for (const auto& [beginning, library] : libraries)
    if (header.starts_with(beginning)) return library;
  return "";
}

// One sentence for an include that this room must not have; "" when it may.
std::string verdict(const std::string& room, const std::string& header, bool quoted) {
  const std::string library = libraryOf(header);
  if (!library.empty() && !rooms.at(room).outside.contains(library))
    return library + " has no place in src/" + room;
  if (!quoted || header.starts_with("shared/")) return "";
  if (header.find("..") != std::string::npos) return "paths begin at src/ or shaders/";
  const std::string target = roomOf(header);
  if (target.empty()) return "it is neither below src/ nor below shaders/shared/";
  if (target != room && !rooms.at(room).mayInclude.contains(target))
    return "src/" + room + " must not know of src/" + target;
  return "";
}

// What is wrong with a file of src/, whose path is given relative to it; a sentence for each line.
std::vector<std::string> violationsIn(const std::string& path, const std::string& text) {
  const std::string room = roomOf(path);
  if (room.empty()) return {path + ": no room of src/ holds this file"};
  static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  static const std::regex openGlCall(R"((^|[^\w:.>])gl[A-Z]\w*\s*\()");
  const bool mayCallOpenGl = rooms.at(room).outside.contains("opengl");

  std::vector<std::string> found;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string place = path + ":" + std::to_string(number) + ": " + line + ": ";
    std::smatch match;
    if (std::regex_match(line, match, include)) {
      const std::string wrong = verdict(room, match[2], match[1] == "\"");
      if (!wrong.empty()) found.push_back(place + wrong);
    } else if (!mayCallOpenGl && std::regex_search(line.substr(0, line.find("//")), openGlCall)) {
      found.push_back(place +
                      "OpenGL is called in src/gl, src/solver/gpu, src/render and src/simulation/gpu alone");
    }
  }
  return found;
}

std::vector<std::string> violationsInTheTree() {
  const fs::path root = fs::path(SOURCE_ROOT) / "src";
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    const std::vector<std::string> more =
        violationsIn(fs::relative(entry.path(), root).generic_string(), readFile(entry.path()));
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

TEST(Includes, PointOneWayInEveryFileOfTheTree) {
  for (const std::string& violation : violationsInTheTree()) ADD_FAILURE() << violation;
}

TEST(Includes, TheTreeHasEveryRoomOfTheTable) {
  for (const auto& [name, room] : rooms)
    EXPECT_TRUE(fs::is_directory(fs::path(SOURCE_ROOT) / "src" / name)) << name;
}

// The check itself, on made-up files: what it must catch, and what it must let pass.
struct Example {
  const char *path, *line;
};

TEST(Includes, CheckCatchesEachKindOfViolation) {
  const Example examples[] = {
      {"cloth/cloth.cpp", "#include \"solver/solver.h\""},            // against the arrow
      {"solver/cpu/cpu_solver.cpp", "#include \"gl/buffer.h\""},      // the twin knows no OpenGL
      {"solver/solver.cpp", "#include \"solver/gpu/gpu_solver.h\""},  // the interface knows no backend
      {"solver/gpu/gpu_solver.cpp",
       "#include \"solver/cpu/rows.h\""},  // one backend knows nothing of the other
      {"gl/program.cpp", "#include \"scene/scene.h\""},
      {"render/renderer.cpp", "#include \"solver/state.h\""},
      {"export/png.cpp", "#include \"render/image.h\""},
      {"render/renderer.cpp", "#include <GLFW/glfw3.h>"},
      {"render/panel.cpp", "  #  include <imgui.h>"},
      {"viewer/viewer.cpp", "#include <glad/gl.h>"},
      {"viewer/viewer.cpp", "#include \"gl/api.h\""},
      {"viewer/viewer.cpp", "  glViewport(0, 0, 1, 1);"},
      {"cloth/cloth.cpp", "#include <glm/glm.hpp>"},
      {"simulation/simulation.cpp", "#include \"simulation/gpu/solvers.h\""},  // knows no OpenGL
      {"session/session.cpp", "#include \"gl/buffer.h\""},
      {"core/files.cpp", "#include \"../scene/scene.h\""},
      {"core/files.cpp", "#include \"misc/things.h\""},
      {"commands/run_command.cpp", "#include <CGAL/intersections.h>"},
      {"solver/solver.cpp", "#include \"measure/crossings.h\""},  // no step depends on measures
      {"viewer/viewer.cpp", "#include \"commands/commands.h\""},
      {"simulation/simulation.cpp", "#include <pybind11/numpy.h>"},
      {"attic/old.cpp", "int x;"},
  };
  for (const Example& example : examples)
    EXPECT_EQ(violationsIn(example.path, example.line).size(), 1u) << example.path << ": " << example.line;
}

TEST(Includes, CheckLetsPassWhatTheHouseAllows) {
  const Example examples[] = {
      {"cloth/cloth.cpp", "#include \"scene/scene.h\""},
      {"core/files.cpp", "#include <fstream>"},
      {"solver/cpu/cpu_solver.cpp", "#include \"shared/step_params.h\""},
      {"solver/gpu/gpu_solver.cpp", "  glDispatchCompute(1, 1, 1);"},
      {"render/renderer.cpp", "#include \"gl/api.h\""},
      {"viewer/viewer.cpp", "  glfwPollEvents();"},
      {"viewer/viewer.cpp", "  // glViewport(0, 0, 1, 1) is the renderer's affair"},
      {"viewer/viewer.cpp", "  gl::initializeCurrentContext(load);"},
      {"commands/doctor.cpp", "#include \"solver/gpu/gpu_solver.h\""},
  };
  for (const Example& example : examples)
    EXPECT_EQ(violationsIn(example.path, example.line), std::vector<std::string>{})
        << example.path << ": " << example.line;
}

}  // namespace
}  // namespace clothsim
