// Text in pictures, without a window: letters outlined by stb_truetype, laid onto an Image.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "render/image.h"

namespace clothsim {

using Color8 = std::array<std::uint8_t, 3>;  // sRGB

// The typeface of everything that the program writes into pictures and windows: Roboto or DejaVu Sans, as far
// as the system has them; empty without either.
[[nodiscard]] std::filesystem::path typefaceFile();

// A typeface. Texts are UTF-8, sizes are those of a line [pixels], from the top of its ascenders to the
// bottom of its descenders.
class PictureFont {
 public:
  // @param file  TrueType or OpenType. Where it is empty or no typeface, stb_easy_font's block letters, which
  //              know ASCII alone, stand in. @throws InputOutputError when it cannot be read
  explicit PictureFont(const std::filesystem::path& file = typefaceFile());
  ~PictureFont();
  PictureFont(const PictureFont&) = delete;
  PictureFont& operator=(const PictureFont&) = delete;

  [[nodiscard]] int width(std::string_view text, int size) const;  // [pixels]
  // The text, cut with "..." at its end where it is wider than `room` [pixels].
  [[nodiscard]] std::string fitted(std::string_view text, int size, int room) const;
  // (x, y) is the left end of the baseline [pixels]; what lies outside of the picture is not drawn. Returns
  // the right end.
  int draw(Image& image, std::string_view text, int size, int x, int y, Color8 color) const;

 private:
  struct Outlines;
  std::unique_ptr<Outlines> outlines_;  // none: block letters
};

// Lays `color` over a pixel; `cover` 0 to 1.
void blend(Image& image, int x, int y, Color8 color, double cover);

}  // namespace clothsim
