// Smooth edges in pictures of one sample a pixel: only tiles of the picture in which there are any are gone
// through, the others are copied, which costs a software renderer next to nothing.
#pragma once

#include <array>
#include <cstdint>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "render/flat_bounds.h"

namespace clothsim {

// Making them throws OpenGlError and InputOutputError.
struct EdgePrograms {
  gl::Program find = gl::Program::makeCompute("render/find_edges.comp");
  gl::Program smooth =
      gl::Program::makeRender("render/edge_tile.vert", "render/resolve.frag", {{"SAMPLES", "1"}});
  gl::Program smoothAll =  // of a picture that is smaller than a tile
      gl::Program::makeRender("render/fullscreen.vert", "render/resolve.frag", {{"SAMPLES", "1"}});
};

class Edges {
 public:
  // Copies the pixels of `part` from the canvas to framebuffer `target`, which is as large, with smooth
  // edges. The RenderFrame of the canvas is bound; leaves `target` bound, and its viewport over all of it.
  void smoothInto(GLuint target, const gl::Framebuffer& canvas, const PixelRect& part,
                  const EdgePrograms& programs);

 private:
  gl::Buffer<std::array<float, 2>> middles_;  // of the tiles that have edges [pixels]
  gl::Buffer<std::uint32_t> command_{"edge command", 4};
  gl::VertexArray tiles_{"edge tiles"}, noVertices_{"no vertices"};
};

}  // namespace clothsim
