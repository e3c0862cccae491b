// Pictures that the processor stretches, and the triangles that throw shadows in draft quality.
#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>

#include "gl/gl_test.h"
#include "render/cloth_mesh.h"
#include "render/stretch.h"

namespace clothsim {
namespace {

constexpr std::uint8_t BLANK = 77;

gl::Framebuffer picture(int width, int height, bool isNoise) {
  gl::Framebuffer framebuffer("picture", {.width = width, .height = height, .color = GL_RGBA8});
  std::mt19937 random(5);
  std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width * height), BLANK);
  if (isNoise)
    for (std::uint8_t& value : pixels) value = static_cast<std::uint8_t>(random());
  glTextureSubImage2D(framebuffer.colorTexture(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                      pixels.data());
  return framebuffer;
}

class StretchTest : public GlTest {
 protected:
  static constexpr int width = 61, height = 37, wide = 101, high = 62;
};

TEST_F(StretchTest, IsWhatOpenGlStretchesToAStep) {
  const gl::Framebuffer small = picture(width, height, true), ours = picture(wide, high, false),
                        theirs = picture(wide, high, false);
  Stretch().run(small, ours, {0, 0, wide, high});
  glBlitNamedFramebuffer(small.name(), theirs.name(), 0, 0, width, height, 0, 0, wide, high,
                         GL_COLOR_BUFFER_BIT, GL_LINEAR);
  const std::vector<std::uint8_t> a = ours.readRgb(), b = theirs.readRgb();
  int most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  EXPECT_LE(most, 2);  // of 255, of noise from 0 to 255: weights of 8 bits, rounded twice
}

TEST_F(StretchTest, OfAPartLeavesTheRestAndMakesTheSamePixels) {
  const gl::Framebuffer small = picture(width, height, true), whole = picture(wide, high, false),
                        partly = picture(wide, high, false);
  const PixelRect part{13, 20, 77, 55};
  Stretch().run(small, whole, {0, 0, wide, high});
  Stretch().run(small, partly, part);
  const std::vector<std::uint8_t> a = whole.readRgb(), b = partly.readRgb();
  for (int row = 0; row < high; ++row)  // from the top
    for (int column = 0; column < wide; ++column) {
      const int y = high - 1 - row;
      const bool isIn = column >= part.left && column < part.right && y >= part.bottom && y < part.top;
      const auto i = 3 * static_cast<std::size_t>(row * wide + column);
      ASSERT_EQ(b[i], isIn ? a[i] : BLANK) << column << " " << y;
    }
}

TEST_F(StretchTest, WithTheTopFirstTurnsTheRowsAround) {
  const gl::Framebuffer small = picture(width, height, true), upright = picture(wide, high, false),
                        turned = picture(wide, high, false);
  const PixelRect part{13, 20, 77, 55};
  Stretch().run(small, upright, part);
  Stretch().run(small, turned, part, true);
  const std::vector<std::uint8_t> a = upright.readRgb(), b = turned.readRgb();
  constexpr auto rowBytes = std::size_t{3} * wide;
  for (std::size_t row = 0; row < high; ++row)
    EXPECT_TRUE(std::equal(a.begin() + row * rowBytes, a.begin() + (row + 1) * rowBytes,
                           b.begin() + (high - 1 - row) * rowBytes))
        << row;
}

// Else llvmpipe would draw what it is to copy into a window (src/gl/framebuffer.cpp).
TEST_F(StretchTest, PicturesAreStoredAsASoftwareRendererStoresWindows) {
  if (!gl::currentContextInfo().software) return;
  const gl::Framebuffer of = picture(width, height, true);
  GLint order = 0;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, of.name());
  glGetIntegerv(GL_IMPLEMENTATION_COLOR_READ_FORMAT, &order);
  EXPECT_EQ(order, GL_BGRA);
}

TEST_F(StretchTest, OfTheSameSizeIsACopy) {
  const gl::Framebuffer from = picture(width, height, true), to = picture(width, height, false);
  Stretch().run(from, to, {0, 0, width, height});
  EXPECT_EQ(to.readRgb(), from.readRgb());
}

TEST_F(StretchTest, OfASinglePixelFillsThePicture) {
  const gl::Framebuffer one = picture(1, 1, false), many = picture(5, 4, true);
  Stretch().run(one, many, {0, 0, 5, 4});
  const std::vector<std::uint8_t> pixels = many.readRgb();
  EXPECT_EQ(std::count(pixels.begin(), pixels.end(), BLANK), 3 * 5 * 4);
}

TEST(CoarseTriangles, CoverTheGridWithEverySecondRowAndColumnAndTheLastOnes) {
  for (const auto& [columns, rows] : {std::pair(9u, 5u), std::pair(8u, 6u), std::pair(2u, 3u)}) {
    const GLuint first = 100;
    const std::vector<std::uint32_t> indices = coarseTriangles(columns, rows, first);
    int doubleArea = 0;
    std::set<std::uint32_t> used;
    for (std::size_t at = 0; at < indices.size(); at += 3) {
      const auto x = [&](std::size_t k) { return static_cast<int>((indices[at + k] - first) % columns); };
      const auto y = [&](std::size_t k) { return static_cast<int>((indices[at + k] - first) / columns); };
      const int area = (x(2) - x(0)) * (y(1) - y(0)) - (x(1) - x(0)) * (y(2) - y(0));
      EXPECT_GT(area, 0) << "wound like the triangles of the grid";
      doubleArea += area;
      used.insert({indices[at], indices[at + 1], indices[at + 2]});
    }
    EXPECT_EQ(doubleArea, static_cast<int>(2 * (columns - 1) * (rows - 1)));
    EXPECT_EQ(used.size(), std::size_t{columns / 2 + 1} * (rows / 2 + 1));
  }
}

}  // namespace
}  // namespace clothsim
