// The README tells what the program does; where it can be compared with the program, it is.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "app/viewer_keys.h"
#include "core/files.h"
#include "scene/scene_io.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

std::string readme() { return readFile(fs::path(SOURCE_ROOT) / "README.md"); }

TEST(Readme, HasTheViewersTableOfKeysLineForLine) {
  std::string table = "| input | effect |\n|---|---|\n";
  for (const ViewerKey& key : viewerKeys)
    table += "| " + std::string(key.input) + " | " + std::string(key.effect) + " |\n";
  EXPECT_NE(readme().find(table + "\n"), std::string::npos) << "expected:\n" << table;
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

TEST(Readme, LinksOnlyToFilesThatExist) {
  const std::string text = readme();
  const std::regex link(R"(\]\(([^)#:]+)\))");
  int links = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), link), none; match != none; ++match, ++links)
    EXPECT_TRUE(fs::exists(fs::path(SOURCE_ROOT) / (*match)[1].str())) << (*match)[1];
  EXPECT_GT(links, 3);
}

}  // namespace
}  // namespace clothsim
