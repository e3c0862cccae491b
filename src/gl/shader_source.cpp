#include "gl/shader_source.h"

#include <algorithm>
#include <optional>
#include <regex>
#include <sstream>

#include "core/error.h"
#include "core/files.h"

namespace clothsim::gl {
namespace {

// The file named by a line `#include "file"`, which GLSL itself does not know.
std::optional<std::string> includedFile(const std::string& line) {
  static const std::regex pattern(R"(^\s*#\s*include\s+"([^"]+)\".*$)");
  std::smatch match;
  if (!std::regex_match(line, match, pattern)) return std::nullopt;
  return match[1].str();
}

// Mesa drops the source number from most errors. Lines of file i are therefore numbered from i * 10,000, so
// that a line number alone identifies the file.
constexpr std::size_t linesPerFile = 10'000;

std::string lineDirective(std::size_t line, std::size_t file) {
  return "#line " + std::to_string(file * linesPerFile + line) + " " + std::to_string(file) + "\n";
}

class Loader {
 public:
  void append(const std::string& file) {
    if (std::find(open_.begin(), open_.end(), file) != open_.end()) {
      std::string circle;
      for (const std::string& name : open_) circle += "shaders/" + name + " -> ";
      throw OpenGlError("Shader includes go round in a circle: " + circle + "shaders/" + file);
    }
    // Once is enough: files need no guards against being included by two others.
    if (std::find(source.files.begin(), source.files.end(), file) != source.files.end()) return;
    open_.push_back(file);
    source.files.push_back(file);
    const std::size_t number = source.files.size() - 1;
    std::istringstream lines(readFile(resourceRoot() / "shaders" / file));
    source.text += lineDirective(1, number);
    std::string line;
    for (std::size_t lineNumber = 1; std::getline(lines, line); ++lineNumber) {
      if (const auto included = includedFile(line)) {
        append(*included);
        source.text += lineDirective(lineNumber + 1, number);
      } else {
        source.text += line + "\n";
      }
    }
    open_.pop_back();
  }

  ShaderSource source;

 private:
  std::vector<std::string> open_;  // from the outermost file to the one being read
};

}  // namespace

ShaderSource loadShaderSource(const std::string& file, const Defines& defines) {
  Loader loader;
  loader.source.text = "#version 450 core\n";
  for (const auto& [name, value] : defines) loader.source.text += "#define " + name + " " + value + "\n";
  loader.append(file);
  return loader.source;
}

std::string readableLog(const std::string& log, const ShaderSource& source) {
  // Mesa "0:12(5): error", NVIDIA "0(12) : error", glslang and AMD "ERROR: 0:12:"; always at the start of a
  // message.
  static const std::regex place(R"((^|\s)(\d+)(?::(\d+)(?:\(\d+\))?|\((\d+)\)))");
  std::string readable;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, place) && match[2].length() <= 4) {
      const std::size_t told = std::stoul(match[3].matched ? match[3].str() : match[4].str());
      const std::size_t file = told < linesPerFile ? std::stoul(match[2].str()) : told / linesPerFile;
      const std::string number = std::to_string(told % linesPerFile);
      if (file < source.files.size()) {
        line = match.prefix().str() + match[1].str() + "shaders/" + source.files[file] + ":" + number +
               match.suffix().str();
      }
    }
    readable += line + "\n";
  }
  return readable;
}

}  // namespace clothsim::gl
