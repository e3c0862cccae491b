// Text in pictures, without a window: letters from Dear ImGui's font atlas, laid onto an Image.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/image.h"

namespace clothsim {

using Color8 = std::array<std::uint8_t, 3>;  // sRGB

// One typeface in several sizes.
class Lettering {
 public:
  explicit Lettering(const std::vector<int>& sizes);  // [pixels], from the top of an ascender to a descender
  ~Lettering();
  Lettering(const Lettering&) = delete;
  Lettering& operator=(const Lettering&) = delete;

  // `size` is one of the constructor's, `text` UTF-8. All in pixels.
  [[nodiscard]] int width(std::string_view text, int size) const;
  // The text, cut with "..." at its end where it is wider than `room`.
  [[nodiscard]] std::string fitted(std::string_view text, int size, int room) const;
  // (x, y) is the left end of the baseline; what lies outside of the picture is not drawn. Returns the right
  // end.
  int draw(Image& image, std::string_view text, int size, int x, int y, Color8 color) const;

 private:
  struct Atlas;
  std::unique_ptr<Atlas> atlas_;
};

// Lays `color` over a pixel; `cover` 0 to 1.
void blend(Image& image, int x, int y, Color8 color, double cover);

}  // namespace clothsim
