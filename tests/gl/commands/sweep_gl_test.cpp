// `clothsim sweep`: its sheet, its table, and what it says to mistakes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/files.h"
#include "output/contact_sheet.h"
#include "output/picture_font.h"
#include "render/textures.h"
#include "support/command.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

using nlohmann::json;

test::CommandResult sweep(const std::string& arguments, const char* errors = "2>&1") {
  return test::runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " CLOTHSIM_PROGRAM " sweep " + arguments + " " +
                          errors);
}

// The part of a picture as one long value, to be compared with others.
std::vector<std::uint16_t> partOf(const LoadedPng& png, const json& pixels) {
  std::vector<std::uint16_t> part;
  for (int y = pixels[1]; y < pixels[1].get<int>() + pixels[3].get<int>(); ++y)
    for (int x = pixels[0]; x < pixels[0].get<int>() + pixels[2].get<int>(); ++x) {
      const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(png.width) +
                                  static_cast<std::size_t>(x));
      part.insert(part.end(), png.rgba.begin() + static_cast<std::ptrdiff_t>(at),
                  png.rgba.begin() + static_cast<std::ptrdiff_t>(at + 3));
    }
  return part;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Of a line of CSV; commas within quotes do not count.
int fieldCount(const std::string& line) {
  int count = 1;
  bool isQuoted = false;
  for (const char c : line) {
    if (c == '"') isQuoted = !isQuoted;
    if (c == ',' && !isQuoted) ++count;
  }
  return count;
}

TEST(Sweep, ShowsThreeByTwoCombinationsThatDifferAndTabulatesThem) {
  const test::TemporaryFolder folder;
  const std::string out = (folder / "sheet.png").string();
  const test::CommandResult result = sweep(
      "-f pinned2 --resolution 8x8 --frames 8 --size 96x72 --json --backend cpu --vary "
      "cloth.ks=50,500,5000 --vary solver.integrator=verlet,implicit --set solver.strain_limit=false --set "
      "solver.simulation_steps=15 --set solver.frames_per_sec=24 --out " +
          out,
      "2>/dev/null");
  ASSERT_EQ(result.exitCode, 0) << result.output;
  const json summary = json::parse(result.output);
  EXPECT_EQ(summary["columns"], 3);
  EXPECT_EQ(summary["rows"], 2);
  ASSERT_EQ(summary["cells"].size(), 6u);

  const std::vector<std::string> lines = linesOf(readFile(folder / "sheet.csv"));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_TRUE(lines[0].starts_with("cloth.ks,solver.integrator,frames,finite,divergence,max_strain,"));
  EXPECT_TRUE(lines[1].starts_with("50,verlet,8,true,,"));
  EXPECT_TRUE(lines[6].starts_with("5000,implicit,8,true,,"));
  for (const std::string& line : lines) EXPECT_EQ(fieldCount(line), fieldCount(lines[0])) << line;

  const LoadedPng png = loadPng(out);
  std::set<std::vector<std::uint16_t>> pictures;
  for (const json& cell : summary["cells"]) {
    const json& pixels = cell["pixels"];
    EXPECT_EQ(pixels[2], 96);
    EXPECT_EQ(pixels[3], 72);
    ASSERT_LE(pixels[0].get<int>() + 96, png.width);
    ASSERT_LE(pixels[1].get<int>() + 72, png.height);
    pictures.insert(partOf(png, pixels));
  }
  EXPECT_EQ(pictures.size(), 6u) << "every combination looks different";
  EXPECT_EQ(folder.fileCount(), 2) << "the sheet, the table and nothing else";
}

TEST(Sweep, GoesOnAfterACombinationThatBlowsUp) {
  const test::TemporaryFolder folder;
  const test::CommandResult result = sweep(
      "-f cs171 --resolution 8x8 --frames 12 --size 64x48 --backend cpu --vary "
      "solver.simulation_steps=1,10 --set cloth.stiffness_reference=4000 --out " +
      (folder / "s.png").string());
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_NE(result.output.find("solver.simulation_steps=1 blew up in step "), std::string::npos)
      << result.output;
  const std::vector<std::string> lines = linesOf(readFile(folder / "s.csv"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_NE(lines[1].find(",false,\"in step "), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find(",12,true,,"), std::string::npos) << lines[2];
}

TEST(Sweep, VariesFramesAndLooksWithoutSimulatingAnew) {
  const test::TemporaryFolder folder;
  const test::CommandResult result = sweep(
      "-f pinned2 --resolution 8x8 --size 32x24 --backend cpu --json --vary frame=0,4 --vary "
      "render.shader=phong,normal --out " +
          (folder / "s.png").string(),
      "2>/dev/null");
  ASSERT_EQ(result.exitCode, 0) << result.output;
  const json cells = json::parse(result.output)["cells"];
  ASSERT_EQ(cells.size(), 4u);
  EXPECT_EQ(cells[0]["frames"], 0);
  EXPECT_EQ(cells[1]["frames"], 4);
  EXPECT_EQ(cells[1]["seconds"], cells[3]["seconds"]) << "one simulation, looked at in two ways";
  const LoadedPng png = loadPng(folder / "s.png");
  EXPECT_NE(partOf(png, cells[1]["pixels"]), partOf(png, cells[3]["pixels"]));
  EXPECT_NE(partOf(png, cells[0]["pixels"]), partOf(png, cells[1]["pixels"]));
}

TEST(Sweep, TellsOfStepsThatEndedUnsolved) {
  const test::TemporaryFolder folder;
  const test::CommandResult result = sweep(
      "-f pinned2 --resolution 8x8 --size 32x24 --backend cpu --json --vary frame=0,6,12 --vary "
      "solver.integrator=verlet,implicit --set solver.newton_steps=1 --set solver.self_collision=false --set "
      "solver.simulation_steps=30 --out " +
          (folder / "s.png").string(),
      "2>/dev/null");
  ASSERT_EQ(result.exitCode, 0) << result.output;
  const json cells = json::parse(result.output)["cells"];
  ASSERT_EQ(cells.size(), 6u);
  for (const std::size_t cell : {0u, 1u, 2u}) {
    EXPECT_EQ(cells[cell]["unconverged_steps"], 0) << "verlet solves nothing";
    EXPECT_EQ(cells[cell]["last_update"], 0);
  }
  EXPECT_EQ(cells[3]["unconverged_steps"], 0) << "nothing has been stepped";
  EXPECT_GT(cells[4]["last_update"], 0);
  EXPECT_EQ(cells[5]["unconverged_steps"], cells[5]["convergence"]["unconverged_steps"]);
  EXPECT_GE(cells[5]["unconverged_steps"], cells[4]["unconverged_steps"]) << "they add up";
  const std::vector<std::string> lines = linesOf(readFile(folder / "s.csv"));
  EXPECT_NE(lines[0].find(",unconverged_steps,last_update,"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find(",0,0.0,cpu,"), std::string::npos) << lines[1];
}

TEST(Sweep, SaysWhatIsWrongBeforeItSimulates) {
  const test::TemporaryFolder folder;
  const std::string out = " --out " + (folder / "s.png").string();
  struct Mistake {
    const char* arguments;
    int exitCode;
    const char* words;
  };
  for (const Mistake& mistake : {
           Mistake{"--frames 1000000 --vary cloth.ks=1,-1", 3, "--vary cloth.ks=-1: cloth.ks: "},
           Mistake{"--frames 1000000 --vary cloth.kz=1,2", 3, "did you mean"},
           Mistake{"--frames 9 --vary cloth.ks", 2, "expected key=value,value"},
           Mistake{"--frames 9 --vary frame=1,2", 2, "give one of them"},
           Mistake{"--frames 9 --resolution 9x9 --vary resolution=4x4,9x9", 2, "--resolution and --vary"},
           Mistake{"--frames 9 --shader phong --vary render.shader=phong,normal", 2, "--shader and --vary"},
           Mistake{"--frames 9 --set cloth.ks=3 --vary cloth.ks=1,2", 2, "--set cloth.ks=... and --vary"},
           Mistake{"--vary cloth.ks=1,2", 2, "--frames is required"},
           Mistake{"--vary frame=1,x", 2, "--vary frame=x: expected the number"},
           Mistake{"--frames 9 --vary resolution=9x9,9", 2, "--vary resolution 9: expected WIDTHxHEIGHT"},
           Mistake{"--frames 9 --vary cloth.ks=1,2 --size 8192x8192", 2, "Choose a smaller --size"},
           Mistake{"--frames 9 --vary cloth.ks=1,2 --view up", 2, "--view up: expected RIGHT,UP"},
           Mistake{"--frames 9 --vary cloth.ks=1,2 --view 1,2,0", 2, "--view 1,2,0: expected RIGHT,UP"},
           Mistake{"--frames 9 --vary cloth.ks=1,2 --view 1,2x", 2, "--view 1,2x: expected RIGHT,UP"},
       }) {
    const test::CommandResult result =
        sweep(std::string("-f pinned2 --backend cpu ") + mistake.arguments + out);
    EXPECT_EQ(result.exitCode, mistake.exitCode) << mistake.arguments << '\n' << result.output;
    EXPECT_NE(result.output.find(mistake.words), std::string::npos) << result.output;
  }
  EXPECT_EQ(sweep("-f pinned2 --frames 1 --vary cloth.ks=1 --out a.jpg").exitCode, 2);
  EXPECT_EQ(sweep("-f pinned2 --frames 1 --vary cloth.ks=1 --out /nowhere/a.png").exitCode, 5);
  EXPECT_EQ(folder.fileCount(), 0);
}

ContactSheet plainSheet(std::size_t count) {
  ContactSheet sheet;
  sheet.title = "title";
  sheet.columnCount = 2;
  sheet.pictureWidth = 60;
  sheet.pictureHeight = 40;
  for (std::size_t i = 0; i < count; ++i) {
    const auto shade = static_cast<std::uint8_t>(20 * i);
    sheet.pictures.push_back({Image{60, 40, std::vector<std::uint8_t>(3 * 60 * 40, shade)}, "words", "", {}});
  }
  return sheet;
}

int darkPixels(const Image& page, int left, int top, int right, int bottom) {
  int dark = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      dark += page.rgb[3 * static_cast<std::size_t>(y * page.width + x)] < 190;
  return dark;
}

TEST(ContactSheet, PutsEachPictureInItsPlaceWithWordsAround) {
  ContactSheet sheet = plainSheet(4);
  sheet.columns = {{"key", "one"}, {"key", "two"}};
  sheet.rows = {{{"row", "a"}}, {{"row", "b"}}};
  const Image page = drawSheet(sheet);
  const SheetPlan plan = planOf(sheet);
  ASSERT_EQ(page.width, plan.width);
  ASSERT_EQ(page.height, plan.height);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [x, y] = plan.pictures[i];
    EXPECT_EQ(page.rgb[3 * static_cast<std::size_t>((y + 20) * page.width + x + 30)], 20 * i);
    EXPECT_GT(page.rgb[3 * static_cast<std::size_t>(y * page.width + x)], 200) << "its corners are round";
    EXPECT_GT(darkPixels(page, x, y + 40, x + 60, std::min(y + 60, page.height)), 5) << "the caption";
  }
  const auto [x, y] = plan.pictures[0];
  EXPECT_GT(darkPixels(page, x, y - 20, x + 60, y), 10) << "the heading of the column";
  EXPECT_GT(darkPixels(page, 0, y, x, y + 40), 10) << "the heading of the row";
  EXPECT_GT(darkPixels(page, 0, 0, x + 60, y - 20), 10) << "the title";
}

TEST(ContactSheet, PalesAPictureUnderAnAlert) {
  ContactSheet sheet = plainSheet(2);
  sheet.pictures[0].alert = "blew up";
  const Image page = drawSheet(sheet);
  const auto [x, y] = planOf(sheet).pictures[0];
  EXPECT_GT(page.rgb[3 * static_cast<std::size_t>((y + 6) * page.width + x + 30)], 100) << "black no more";
}

// Of the program's typeface, and of the block letters that stand in where there is none.
TEST(PictureFont, FitsWordsIntoTheRoomThereIs) {
  for (const auto& file : {typefaceFile(), std::filesystem::path{}}) {
    const PictureFont font(file);
    EXPECT_EQ(font.fitted("short", 20, 500), "short");
    const std::string cut = font.fitted("a long text with \xc3\xa4 in it", 20, 90);
    EXPECT_TRUE(cut.ends_with("..."));
    EXPECT_LE(font.width(cut, 20), 90);
    EXPECT_EQ(font.fitted("abc", 20, 1), "...");
  }
}

TEST(PictureFont, DrawsAboveTheBaselineAndNoFartherThanItsWidth) {
  for (const auto& file : {typefaceFile(), std::filesystem::path{}}) {
    const PictureFont font(file);
    Image page{200, 60, std::vector<std::uint8_t>(std::size_t{3} * 200 * 60, 255)};
    const int end = font.draw(page, "NEW", 24, 30, 40, {0, 0, 0});
    EXPECT_EQ(end, 30 + font.width("NEW", 24));
    EXPECT_GT(darkPixels(page, 30, 18, end, 40), 60);
    EXPECT_EQ(darkPixels(page, 0, 0, 200, 60), darkPixels(page, 29, 18, end + 1, 41))
        << "nothing beside the word";
    font.draw(page, "NEW", 24, 190, 10, {0, 0, 0});
    font.draw(page, "", 24, 10, 10, {0, 0, 0});
  }
}

}  // namespace
}  // namespace clothsim
