// The controls beside the picture, drawn into a framebuffer of their own and only when they have changed: on
// a software renderer that would otherwise take a fifth of every picture's time.
#pragma once

#include <cstddef>
#include <vector>

#include "gl/framebuffer.h"

struct ImDrawData;
struct ImDrawList;

namespace clothsim {

class KeptPanels {
 public:
  // Shows the lists of `data` that lie wholly right of `left` [pixels] in the bound framebuffer, and draws
  // the others over it.
  void draw(const ImDrawData& data, float left);
  void forget() { drawn_.clear(); }  // what is in the textures that the lists name has changed

 private:
  gl::Framebuffer kept_;
  std::vector<std::byte> drawn_;  // vertices, indices and commands that kept_ shows
};

}  // namespace clothsim
