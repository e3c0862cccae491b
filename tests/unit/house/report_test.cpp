// The report's sources name pictures and measurements; what they name is there, and the pictures can be made
// again.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "core/files.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

const fs::path root = SOURCE_ROOT;

std::string sources() {
  std::string text = readFile(root / "report/report.tex");
  for (const char* folder : {"report/sections", "report/diagrams"})
    for (const auto& entry : fs::directory_iterator(root / folder)) text += readFile(entry.path());
  return text;
}

// The first group of every match.
std::set<std::string> namedIn(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::set<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it)
    names.insert((*it)[1]);
  return names;
}

TEST(Report, ShowsNoPictureThatIsNotListedWithItsCommand) {
  const std::string list = readFile(root / "docs/figures.md");
  const std::set<std::string> pictures = namedIn(sources(), R"(\\includegraphics\[[^\]]*\]\{([^}]*)\})");
  EXPECT_GE(pictures.size(), 10u) << "the pattern no longer finds the pictures";
  for (const std::string& picture : pictures) {
    EXPECT_TRUE(fs::exists(root / (picture + ".png"))) << picture;
    if (!picture.starts_with("report/")) continue;  // the README's
    EXPECT_NE(list.find("| " + picture + ".png | "), std::string::npos)
        << picture << ".png has no row in docs/figures.md";
  }
}

TEST(Report, HasNoPictureThatItDoesNotShow) {
  const std::string text = sources();
  for (const auto& entry : fs::directory_iterator(root / "report/figures"))
    EXPECT_NE(text.find("{report/figures/" + entry.path().stem().string() + "}"), std::string::npos)
        << entry.path();
}

TEST(Report, ReadsMeasurementsThatAreThereOrSaysThatTheyMayBeMissing) {
  const std::string script = readFile(root / "report/make_data.py");
  const std::set<std::string> files = namedIn(script, R"x(rows_of\("([^"]*)"\))x");
  EXPECT_GE(files.size(), 5u) << "the pattern no longer finds the files";
  for (const std::string& file : files)
    EXPECT_TRUE(fs::exists(root / "report/data" / file) ||
                script.find("\n  " + file + "  ") != std::string::npos)
        << file;
}

TEST(Report, CitesWhatItListsAndListsWhatItCites) {
  const std::string text = sources();
  const std::set<std::string> cited = namedIn(text, R"(\\cite\{([^}]*)\})");
  const std::set<std::string> listed = namedIn(text, R"(\\bibitem\{([^}]*)\})");
  EXPECT_EQ(cited, listed);
}

TEST(Report, IsBuilt) { EXPECT_GT(fs::file_size(root / "report/report.pdf"), 100'000u); }

}  // namespace
}  // namespace clothsim
