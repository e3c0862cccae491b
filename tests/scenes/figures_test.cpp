// docs/figures.md lists every figure with its command: the list is whole, and the commands work.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "core/files.h"
#include "support/command.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

const fs::path root = SOURCE_ROOT;

// tools/gallery with some arguments, as a shell takes it.
test::CommandResult gallery(const std::string& arguments) {
  std::string command = "env -u DISPLAY -u WAYLAND_DISPLAY " SOURCE_ROOT "/tools/gallery ";
  command += arguments;
  command += " 2>&1";
  return test::runCommand(command);
}

// All that the first group of the expression finds.
std::set<std::string> findAll(const std::string& text, const std::regex& expression) {
  std::set<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), expression), none; match != none; ++match)
    found.insert((*match)[1]);
  return found;
}

// The files in the first column of the page's tables.
std::set<std::string> listedFiles() {
  return findAll(readFile(root / "docs/figures.md"), std::regex(R"(\n\| ([\w./-]+) \|[^\n]*\| `[^\n]+` \|)"));
}

TEST(Figures, OfTheReadmeAreListed) {
  const std::set<std::string> listed = listedFiles();
  const std::set<std::string> shown =
      findAll(readFile(root / "README.md"), std::regex(R"(!\[[^\]]*\]\(([^)]+)\))"));
  EXPECT_GT(shown.size(), 5u);
  for (const std::string& file : shown) EXPECT_TRUE(listed.contains(file)) << file;
}

TEST(Figures, OfTheReportAndItsDataAreListed) {
  const std::set<std::string> listed = listedFiles();
  const auto isListed = [&](const std::string& path) {
    return std::any_of(listed.begin(), listed.end(), [&](const std::string& file) {
      return file == path || file.starts_with(path + ".");  // LaTeX leaves the extension out
    });
  };
  for (const auto& entry : fs::recursive_directory_iterator(root / "report")) {
    const std::string name = fs::relative(entry.path(), root).generic_string();
    if (entry.path().extension() == ".csv" && name.starts_with("report/data/")) {
      EXPECT_TRUE(isListed(name)) << name;
    }
    if (entry.path().extension() != ".tex") continue;
    const std::regex picture(R"(\\includegraphics(?:\[[^\]]*\])?\{([^}]+)\})");
    for (const std::string& file : findAll(readFile(entry.path()), picture)) {
      const bool isFound = isListed(file) || isListed("report/" + file);
      EXPECT_TRUE(isFound) << name << " shows " << file;
    }
  }
}

TEST(Figures, OfTheListAreThere) {
  for (const std::string& file : listedFiles()) EXPECT_TRUE(fs::exists(root / file)) << file;
}

TEST(Figures, AreMadeByTheirCommands) {
  const test::TemporaryFolder folder;
  const test::CommandResult result =
      gallery("--quick --program " CLOTHSIM_PROGRAM " --out " + folder.path().string());
  EXPECT_EQ(result.exitCode, 0) << result.output;
}

TEST(Figures, ThatFailAreNamed) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(gallery("nowhere.png").exitCode, 2);
  const test::CommandResult broken =
      gallery("fold.png --quick --program /bin/false --out " + folder.path().string());
  EXPECT_EQ(broken.exitCode, 1);
  EXPECT_NE(broken.output.find("assets/readme/fold.png: exit code 1"), std::string::npos) << broken.output;
}

}  // namespace
}  // namespace clothsim
