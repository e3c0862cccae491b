// The README tells what the program does; where it can be compared with the program, it is.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "core/files.h"
#include "scene_io/scene_io.h"
#include "viewer/viewer_keys.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

std::string readme() { return readFile(fs::path(SOURCE_ROOT) / "README.md"); }

TEST(Docs, HaveTheViewersTableOfKeysLineForLine) {
  std::string table = "| input | effect |\n|---|---|\n";
  for (const ViewerKey& key : viewerKeys)
    table += "| " + std::string(key.input) + " | " + std::string(key.effect) + " |\n";
  const std::string page = readFile(fs::path(SOURCE_ROOT) / "docs/viewer.md");
  EXPECT_NE(page.find(table), std::string::npos) << "expected:\n" << table;
}

TEST(Readme, ShowsAPictureInItsFirstTenLines) {
  const std::string text = readme();
  std::size_t end = 0;
  for (int line = 0; line < 10; ++line) end = text.find('\n', end) + 1;
  EXPECT_LT(text.find("!["), end);
}

TEST(Readme, ShowsASceneThatLoads) {
  const std::string text = readme(), begin = "```json\n";
  const std::size_t start = text.find(begin) + begin.size();
  const Scene scene = parseScene(text.substr(start, text.find("```", start) - start), "README.md");
  EXPECT_EQ(scene.cloths[0].numWidthPoints, 64);
  EXPECT_TRUE(scene.wind.has_value());
}

// Links of a page that lead nowhere; those within the page and to other sites are not looked at.
std::vector<std::string> brokenLinks(const fs::path& page) {
  const std::string text = readFile(page);
  const std::regex link(R"(\]\(([^)#:]+)\))");
  std::vector<std::string> broken;
  for (std::sregex_iterator match(text.begin(), text.end(), link), none; match != none; ++match)
    if (!fs::exists(page.parent_path() / (*match)[1].str())) broken.push_back((*match)[1]);
  return broken;
}

TEST(Readme, LinksOnlyToFilesThatExist) {
  EXPECT_EQ(brokenLinks(fs::path(SOURCE_ROOT) / "README.md"), std::vector<std::string>{});
}

TEST(Docs, LinkOnlyToFilesThatExist) {
  int pages = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(SOURCE_ROOT) / "docs")) {
    EXPECT_EQ(brokenLinks(entry.path()), std::vector<std::string>{}) << entry.path();
    ++pages;
  }
  EXPECT_GE(pages, 3);
}

// Each page can be found from the README.
TEST(Docs, AreLinkedFromTheReadme) {
  for (const auto& entry : fs::directory_iterator(fs::path(SOURCE_ROOT) / "docs"))
    EXPECT_NE(readme().find("](docs/" + entry.path().filename().string() + ")"), std::string::npos)
        << entry.path();
}

}  // namespace
}  // namespace clothsim
