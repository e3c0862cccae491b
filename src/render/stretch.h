// A picture in more pixels, by the processor: what a software renderer would do through its shaders in four
// times as long.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gl/framebuffer.h"
#include "render/flat_bounds.h"

namespace clothsim {

struct PictureSize {
  int width = 0, height = 0;  // [pixels], > 0
  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

// Between two pictures of four bytes a pixel, row by row from the bottom: each pixel of `part` of the larger
// one is mixed from the four of the smaller one around it, by their distances, as GL_LINEAR does. `into` has
// the pixels of `part` alone, with `topFirst` from the top.
void stretchPixels(std::span<const std::uint8_t> from, PictureSize fromSize, PictureSize toSize,
                   const PixelRect& part, bool topFirst, std::span<std::uint8_t> into);

// From a framebuffer of GL_RGBA8 to another texture of that kind, through memory.
class Stretch {
 public:
  // `part` [pixels of the picture in the end] is all that changes. `topFirst`: the top row of `to` comes
  // first.
  void run(const gl::Framebuffer& from, GLuint to, PictureSize toSize, const PixelRect& part,
           bool topFirst = false);
  void run(const gl::Framebuffer& from, const gl::Framebuffer& to, const PixelRect& part,
           bool topFirst = false) {
    run(from, to.colorTexture(), {to.format().width, to.format().height}, part, topFirst);
  }

 private:
  std::vector<std::uint8_t> small_, large_;
};

}  // namespace clothsim
