// For a software renderer: the controls beside the picture, drawn into a framebuffer of their own and only
// when they have changed. They would otherwise take a fifth of every picture's time.
#pragma once

#include <cstddef>
#include <vector>

#include "gl/framebuffer.h"
#include "render/stretch.h"

struct ImDrawData;
struct ImDrawList;

namespace clothsim {

class KeptPanels {
 public:
  // Shows the lists of `data` that lie wholly right of `left` [pixels] in the window, and draws the others
  // over it. `isNew`: the lists may differ from the last ones.
  void draw(const ImDrawData& data, float left, bool isNew);
  void forget() { drawn_.clear(); }  // what is in the textures that the lists name has changed

 private:
  gl::Framebuffer drawing_, kept_;  // what is drawn; the same with the top row first
  Stretch copier_;
  std::vector<std::byte> drawn_;  // vertices, indices and commands that kept_ shows
};

}  // namespace clothsim
