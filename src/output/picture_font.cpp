#include "output/picture_font.h"

#include <stb/stb_easy_font.h>
#include <stb/stb_truetype.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/files.h"
#include "core/utf8.h"

namespace clothsim {
std::filesystem::path typefaceFile() {
  for (const char* path :
       {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf",
        "/usr/share/fonts/truetype/roboto/Roboto-Medium.ttf",
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path;
  }
  return {};
}

struct PictureFont::Outlines {
  std::string file;
  stbtt_fontinfo info;

  [[nodiscard]] float scaleOf(int size) const {
    return stbtt_ScaleForPixelHeight(&info, static_cast<float>(size));
  }

  // Calls visit(glyph, x) for every letter, x its left end, and returns the right end [pixels].
  template <class Visit>
  float forEachGlyph(std::string_view text, float scale, Visit visit) const {
    float x = 0;
    for (int before = 0; !text.empty();) {
      const Utf8Character letter = firstCharacter(text);
      text.remove_prefix(letter.bytes);
      const int glyph = stbtt_FindGlyphIndex(&info, static_cast<int>(letter.code));
      if (before != 0) x += scale * static_cast<float>(stbtt_GetGlyphKernAdvance(&info, before, glyph));
      visit(glyph, x);
      int advance = 0;
      stbtt_GetGlyphHMetrics(&info, glyph, &advance, nullptr);
      x += scale * static_cast<float>(advance);
      before = glyph;
    }
    return x;
  }

  // The letter begins at `x`, between pixels.
  void drawGlyph(Image& image, int glyph, float scale, float x, int y, Color8 color) const {
    const float whole = std::floor(x), shift = x - whole;
    int left = 0, top = 0, right = 0, bottom = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&info, glyph, scale, scale, shift, 0, &left, &top, &right, &bottom);
    const int columns = right - left, rows = bottom - top;
    if (columns <= 0 || rows <= 0) return;
    std::vector<unsigned char> cover(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    stbtt_MakeGlyphBitmapSubpixel(&info, cover.data(), columns, rows, columns, scale, scale, shift, 0, glyph);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        blend(image, static_cast<int>(whole) + left + column, y + top + row, color,
              cover[static_cast<std::size_t>(row * columns + column)] / 255.0);
  }
};

namespace {

// stb_easy_font's letters are 7 of its pixels high above the baseline, and its lines 12.
int easyScale(int size) { return std::max(1, (size + 6) / 12); }

struct EasyText {
  struct Rectangle {
    int left, top, right, bottom;  // from the left end of the baseline
  };
  std::vector<Rectangle> rectangles;
  int width = 0;

  EasyText(std::string_view text, int scale) {
    std::string ascii(text);
    for (char& c : ascii)
      if (c < ' ' || c > '~') c = '?';
    struct Vertex {
      float x, y, z;
      std::uint32_t color;
    };
    std::vector<Vertex> vertices(64 * ascii.size());  // a letter takes 17 on average
    const int quads = stb_easy_font_print(0, -7, ascii.data(), nullptr, vertices.data(),
                                          static_cast<int>(vertices.size() * sizeof(Vertex)));
    const auto pixel = [&](float coordinate) { return scale * static_cast<int>(coordinate); };
    for (std::size_t k = 0; k < 4 * static_cast<std::size_t>(quads); k += 4)
      rectangles.push_back(
          {pixel(vertices[k].x), pixel(vertices[k].y), pixel(vertices[k + 2].x), pixel(vertices[k + 2].y)});
    width = scale * stb_easy_font_width(ascii.data());
  }
};

}  // namespace

PictureFont::PictureFont(const std::filesystem::path& file) {
  if (file.empty()) return;
  auto outlines = std::make_unique<Outlines>();
  outlines->file = readFile(file);
  const auto* bytes = reinterpret_cast<const unsigned char*>(outlines->file.data());
  const int offset = stbtt_GetFontOffsetForIndex(bytes, 0);
  if (offset >= 0 && stbtt_InitFont(&outlines->info, bytes, offset) != 0) outlines_ = std::move(outlines);
}

PictureFont::~PictureFont() = default;

int PictureFont::width(std::string_view text, int size) const {
  if (!outlines_) return EasyText(text, easyScale(size)).width;
  return static_cast<int>(
      std::ceil(outlines_->forEachGlyph(text, outlines_->scaleOf(size), [](int, float) {})));
}

std::string PictureFont::fitted(std::string_view text, int size, int room) const {
  if (width(text, size) <= room) return std::string(text);
  while (!text.empty() && width(std::string(text) + "...", size) > room) text = withoutLastCharacter(text);
  return std::string(text) + "...";
}

int PictureFont::draw(Image& image, std::string_view text, int size, int x, int y, Color8 color) const {
  if (outlines_) {
    const float scale = outlines_->scaleOf(size);
    return x + static_cast<int>(std::ceil(outlines_->forEachGlyph(text, scale, [&](int glyph, float at) {
             outlines_->drawGlyph(image, glyph, scale, static_cast<float>(x) + at, y, color);
           })));
  }
  const EasyText letters(text, easyScale(size));
  for (const auto& [left, top, right, bottom] : letters.rectangles)
    for (int row = top; row < bottom; ++row)
      for (int column = left; column < right; ++column) blend(image, x + column, y + row, color, 1);
  return x + letters.width;
}

void blend(Image& image, int x, int y, Color8 color, double cover) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::uint8_t* pixel = &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                        static_cast<std::size_t>(x))];
  for (std::size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<std::uint8_t>(std::lround(pixel[i] + cover * (color[i] - pixel[i])));
}

}  // namespace clothsim
