#include "output/lettering.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <cassert>
#include <cmath>
#include <map>

#include "output/typeface.h"

namespace clothsim {
namespace {

// The letters of the text, one after the other: at(glyph, x of its left end).
template <class At>
float forEachGlyph(const ImFont& font, std::string_view text, At at) {
  float x = 0;
  const char *next = text.data(), *const end = next + text.size();
  while (next < end) {
    unsigned int letter = 0;
    next += ImTextCharFromUtf8(&letter, next, end);
    const ImFontGlyph* glyph = font.FindGlyph(static_cast<ImWchar>(letter));
    if (glyph == nullptr) continue;
    at(*glyph, x);
    x += glyph->AdvanceX;
  }
  return x;
}

}  // namespace

struct Lettering::Atlas {
  ImFontAtlas fonts;
  std::map<int, const ImFont*> sizes;
  unsigned char* cover = nullptr;  // of all letters, 0 to 255; the atlas owns it
  int width = 0, height = 0;

  [[nodiscard]] const ImFont& at(int size) const {
    const auto found = sizes.find(size);
    assert(found != sizes.end() && "a size that the constructor was not told of");
    return *found->second;
  }
};

Lettering::Lettering(const std::vector<int>& sizes) : atlas_(std::make_unique<Atlas>()) {
  for (const int size : sizes)
    if (!atlas_->sizes.contains(size))
      atlas_->sizes[size] = addTypeface(atlas_->fonts, static_cast<float>(size), true);
  atlas_->fonts.GetTexDataAsAlpha8(&atlas_->cover, &atlas_->width, &atlas_->height);
}

Lettering::~Lettering() = default;

int Lettering::width(std::string_view text, int size) const {
  return static_cast<int>(std::ceil(forEachGlyph(atlas_->at(size), text, [](const ImFontGlyph&, float) {})));
}

std::string Lettering::fitted(std::string_view text, int size, int room) const {
  if (width(text, size) <= room) return std::string(text);
  std::string shorter(text);
  while (!shorter.empty() && width(shorter + "...", size) > room) {
    // A letter of UTF-8 goes as a whole.
    while (shorter.size() > 1 && (static_cast<unsigned char>(shorter.back()) & 0xc0) == 0x80)
      shorter.pop_back();
    shorter.pop_back();
  }
  return shorter + "...";
}

int Lettering::draw(Image& image, std::string_view text, int size, int x, int y, Color8 color) const {
  const ImFont& font = atlas_->at(size);
  const float top = static_cast<float>(y) - font.Ascent;  // a glyph's Y0 counts from the top of its line
  const float end = forEachGlyph(font, text, [&](const ImFontGlyph& glyph, float at) {
    if (!glyph.Visible) return;
    const auto texel = [](float coordinate, int texels) {
      return static_cast<int>(std::lround(coordinate * static_cast<float>(texels)));
    };
    const int u = texel(glyph.U0, atlas_->width), v = texel(glyph.V0, atlas_->height);
    const int columns = texel(glyph.U1, atlas_->width) - u, rows = texel(glyph.V1, atlas_->height) - v;
    const int left = x + static_cast<int>(std::lround(at + glyph.X0));
    const int above = static_cast<int>(std::lround(top + glyph.Y0));
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        blend(image, left + column, above + row, color,
              atlas_->cover[(v + row) * atlas_->width + u + column] / 255.0);
  });
  return x + static_cast<int>(std::ceil(end));
}

void blend(Image& image, int x, int y, Color8 color, double cover) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::uint8_t* pixel = &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                        static_cast<std::size_t>(x))];
  for (std::size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<std::uint8_t>(std::lround(pixel[i] + cover * (color[i] - pixel[i])));
}

}  // namespace clothsim
