// Files and tests that comments and pages name exist: a name that has gone stale sends its reader nowhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cloth/material.h"
#include "core/files.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> folders{"src",    "shaders", "tests", "docs",     "tools", "report",
                                       "assets", "cmake",   ".ci",   "examples", "python"};

// All files and folders of the repository, and the headers of other libraries that its code includes.
class Tree {
 public:
  explicit Tree(const fs::path& root) {
    for (const auto& entry : fs::directory_iterator(root))
      if (entry.is_regular_file()) add(entry.path().filename().string());
    for (const std::string& folder : folders) {
      add(folder);
      for (const auto& entry : fs::recursive_directory_iterator(root / folder))
        add(entry.path().lexically_relative(root).string());
    }
  }
  Tree(std::initializer_list<std::string> paths) {
    for (const std::string& path : paths) add(path);
  }
  void add(const std::string& path) {
    paths_.insert(path);
    for (std::size_t at = 0;; ++at) {  // by its ends, too: "solver/state.h", "state.h"
      ends_.insert(path.substr(at));
      at = path.find('/', at);
      if (at == std::string::npos) break;
    }
  }
  [[nodiscard]] const std::set<std::string>& paths() const { return paths_; }
  // Whether `name` is a file or folder: a path from the root, or the end of one. "*" stands for any part of a
  // name, and NAME for such a part, too.
  [[nodiscard]] bool has(std::string name) const {
    while (name.ends_with('/')) name.pop_back();
    for (std::size_t at = name.find("NAME"); at != std::string::npos; at = name.find("NAME"))
      name.replace(at, 4, "*");
    if (name.find('*') == std::string::npos) return ends_.contains(name);
    return std::any_of(ends_.begin(), ends_.end(),
                       [&](const std::string& end) { return matches(name, end); });
  }

 private:
  static bool matches(std::string_view pattern, std::string_view name) {
    if (pattern.empty()) return name.empty();
    if (pattern.front() != '*')
      return !name.empty() && pattern.front() == name.front() && matches(pattern.substr(1), name.substr(1));
    for (std::size_t skipped = 0;; ++skipped) {
      if (matches(pattern.substr(1), name.substr(skipped))) return true;
      if (skipped == name.size() || name[skipped] == '/') return false;
    }
  }
  std::set<std::string> paths_, ends_;
};

// What a pair of braces with commas stands for: every text between them, in its place.
std::vector<std::string> alternatives(const std::string& name) {
  const std::size_t open = name.find('{'), close = name.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {name};
  std::vector<std::string> result;
  for (std::size_t at = open + 1; at <= close;) {
    const std::size_t end = std::min(name.find(',', at), close);
    for (const std::string& rest : alternatives(name.substr(close + 1)))
      result.push_back(name.substr(0, open) + name.substr(at, end - at) + rest);
    at = end + 1;
  }
  return result;
}

// Whether a word of a text looks like the name of a file or folder of the repository.
bool isName(std::string_view word) {
  for (const std::string_view ending :
       {".h", ".cpp", ".glsl", ".comp", ".vert", ".frag", ".geom", ".md", ".cmake", ".py"})
    if (word.size() > ending.size() && word.ends_with(ending) && word[word.size() - ending.size() - 1] != '/')
      return true;
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return word.starts_with(folder + "/"); });
}

// Words of a text that look like names of files but are none. Addresses, and paths elsewhere ("/usr/...",
// "~/...", "build/...", "out/..."), are passed over.
std::vector<std::string> staleNames(const std::string& text, const Tree& tree) {
  constexpr std::string_view marks = "_./{},*-+~:";
  const auto isPart = [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || marks.find(c) != std::string_view::npos;
  };
  std::vector<std::string> stale;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin;
    int open = 0;  // a comma belongs to a name within braces alone
    for (; end < text.size() && isPart(text[end]) && (text[end] != ',' || open > 0); ++end)
      open += text[end] == '{' ? 1 : text[end] == '}' ? -1 : 0;
    std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    while (!word.empty() && std::string_view(".:,-").find(word.back()) != std::string_view::npos)
      word.pop_back();
    while (word.starts_with("../") || word.starts_with("./")) word.erase(0, word.find('/') + 1);
    if (const std::size_t line = word.find(':');
        line != std::string::npos && word.find("//") == std::string::npos)
      word.resize(line);  // of a place in a file
    const bool isElsewhere = word.starts_with('/') || word.starts_with('~') || word.starts_with("build/") ||
                             word.starts_with("out/") || word.find("//") != std::string::npos;
    if (isElsewhere || !isName(word)) continue;
    for (const std::string& name : alternatives(word))
      if (!tree.has(name)) stale.push_back(name);
  }
  return stale;
}

// The comments of a source text, a line each as it stands there; nothing of its code.
std::string commentsOf(const std::string& source, std::string_view sign) {
  std::string comments;
  for (std::size_t begin = 0; begin < source.size();) {
    const std::size_t end = std::min(source.find('\n', begin), source.size());
    const std::string_view line = std::string_view(source).substr(begin, end - begin);
    char quote = '\0';
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (quote != '\0') {
        if (line[i] == '\\')
          ++i;
        else if (line[i] == quote)
          quote = '\0';
      } else if (line.substr(i).starts_with(sign) && (sign != "#" || i == 0 || line[i - 1] == ' ')) {
        comments.append(line.substr(i + sign.size())).append("\n");
        break;
      } else if (line[i] == '"') {
        quote = line[i];
      }
    }
    begin = end + 1;
  }
  return comments;
}

// What of a file is written for people: all of a page, of the changelog what is not released yet, and
// comments of the rest.
std::string proseOf(const fs::path& path, const std::string& text) {
  if (path.filename() == "CHANGELOG.md") return text.substr(0, text.find("\n## [", text.find("\n## [") + 1));
  if (path.extension() == ".md") return text;
  for (const char* extension : {".h", ".cpp", ".glsl", ".comp", ".vert", ".frag", ".geom"})
    if (path.extension() == extension) return commentsOf(text, "//");
  return commentsOf(text, "#");
}

const fs::path sourceRoot = SOURCE_ROOT;

bool isRead(const std::string& path) {
  if (path.starts_with("report/") || path.starts_with("assets/") || path.starts_with("tests/data/") ||
      path.starts_with("tests/fuzz/corpus/") || path.starts_with("tests/fuzz/regressions/"))
    return false;
  return fs::is_regular_file(sourceRoot / path) && fs::path(path).extension() != ".png";
}

TEST(Names, OfFilesInCommentsAndPagesAreThoseOfFilesThatExist) {
  Tree tree(sourceRoot);
  const std::set<std::string> own = tree.paths();
  int read = 0;
  std::vector<std::pair<std::string, std::string>> prose;
  for (const std::string& path : own) {
    if (!isRead(path)) continue;
    const std::string text = readFile(sourceRoot / path);
    for (std::size_t at = text.find("#include <"); at != std::string::npos;
         at = text.find("#include <", at + 1))
      tree.add(text.substr(at + 10, text.find('>', at) - at - 10));
    prose.emplace_back(path, proseOf(path, text));
    ++read;
  }
  for (const auto& [path, text] : prose)
    EXPECT_EQ(staleNames(text, tree), std::vector<std::string>{}) << path;
  EXPECT_GT(read, 400);
}

TEST(Names, ThatHaveGoneStaleAreFoundHoweverTheyAreWritten) {
  const Tree tree{"src/core/vec.h", "src/solver/cpu/forces.cpp", "shaders/sim/air.glsl", "tools/fuzz", "docs",
                  "docs/physics.md"};
  using Found = std::vector<std::string>;
  EXPECT_EQ(
      staleNames(
          "See core/vec.h, forces.cpp:12 and shaders/sim/{air}.glsl; tools/fuzz runs. (docs/physics.md)",
          tree),
      Found{});
  EXPECT_EQ(
      staleNames("NAME.glsl, src/*/vec.h, https://a.org/x.h, /usr/include/y.h, build/z.h, ../docs/", tree),
      Found{});
  EXPECT_EQ(staleNames("core/vec3.h", tree), Found{"core/vec3.h"});
  EXPECT_EQ(staleNames("(DESIGN.md section 3)", tree), Found{"DESIGN.md"});
  EXPECT_EQ(staleNames("shaders/sim/{air,wind}.glsl", tree), Found{"shaders/sim/wind.glsl"});
  EXPECT_EQ(staleNames("tools/fuzzer, src/gone/.", tree), (Found{"tools/fuzzer", "src/gone/"}));
  EXPECT_EQ(staleNames("../src/solver/forces.cpp", tree), Found{"src/solver/forces.cpp"});
  EXPECT_EQ(commentsOf("int a;  // of a.h\nf(\"// b.h\");\n", "//"), " of a.h\n");
  EXPECT_EQ(commentsOf("a=$#b.h  # of c.h\n", "#"), " of c.h\n");
  EXPECT_EQ(proseOf("CHANGELOG.md", "# C\n\n## [Unreleased]\na.h\n\n## [1]\nb.h\n"),
            "# C\n\n## [Unreleased]\na.h\n");
}

// "Suite.Name" of every test.
std::set<std::string> testNames() {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(sourceRoot / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = readFile(entry.path());
    for (std::size_t at = text.find("TEST"); at != std::string::npos; at = text.find("TEST", at + 1)) {
      const std::size_t open = text.find('(', at), comma = text.find(',', at), close = text.find(')', at);
      if (open > at + 6 || comma > close || close == std::string::npos) continue;
      const std::size_t name = text.find_first_not_of(" \n", comma + 1);
      names.insert(text.substr(open + 1, comma - open - 1) + "." + text.substr(name, close - name));
    }
  }
  return names;
}

// What of a page stands between backquotes and looks like "Suite.Name".
std::vector<std::string> testsNamedIn(const std::string& page) {
  std::vector<std::string> named;
  for (std::size_t open = page.find('`'); open != std::string::npos; open = page.find('`', open + 1)) {
    const std::size_t close = page.find('`', open + 1);
    if (close == std::string::npos) break;
    const std::string word = page.substr(open + 1, close - open - 1);
    const std::size_t dot = word.find('.');
    if (dot != std::string::npos && dot + 1 < word.size() &&
        std::isupper(static_cast<unsigned char>(word[0])) != 0 &&
        std::isupper(static_cast<unsigned char>(word[dot + 1])) != 0)
      named.push_back(word);
    open = close;
  }
  return named;
}

TEST(Physics, NamesTestsThatExist) {
  const std::set<std::string> tests = testNames();
  const std::vector<std::string> named = testsNamedIn(readFile(sourceRoot / "docs/physics.md"));
  EXPECT_GT(named.size(), 80u);
  for (const std::string& test : named) EXPECT_TRUE(tests.contains(test)) << test;
  EXPECT_FALSE(tests.contains("Physics.NamesTestsThatDoNot"));
}

TEST(Physics, ListsThePresetsAsTheyAre) {
  const std::string page = readFile(sourceRoot / "docs/physics.md");
  for (const std::string& name : materialPresetNames()) {
    const Material m = *materialPreset(name);
    std::string row = "| " + name;
    for (const double value : {m.density, m.stretch, m.shear, m.bend, m.damping, m.thickness, m.friction}) {
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.6g", value);
      row.append(" | ").append(text.data());
    }
    EXPECT_NE(page.find(row + " |\n"), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace clothsim
