#include "render/edges.h"

#include "shared/render_layout.h"

namespace clothsim {

void Edges::smoothInto(GLuint target, const gl::Framebuffer& canvas, const PixelRect& part,
                       const EdgePrograms& programs) {
  const int width = canvas.format().width, height = canvas.format().height;
  glDisable(GL_SCISSOR_TEST);  // with it a software renderer would draw the copy
  glBlitNamedFramebuffer(canvas.name(), target, part.left, part.bottom, part.right, part.top, part.left,
                         part.bottom, part.right, part.top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(CANVAS_UNIT, canvas.colorTexture());
  if (width < EDGE_TILE || height < EDGE_TILE) {
    programs.smoothAll.bind();
    noVertices_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return;
  }

  const auto upTo = [](int pixels) { return (pixels + EDGE_TILE - 1) / EDGE_TILE; };
  const int left = part.left / EDGE_TILE, bottom = part.bottom / EDGE_TILE, right = upTo(part.right),
            top = upTo(part.top);
  if (right <= left || top <= bottom) return;
  const auto most = static_cast<std::size_t>(upTo(width)) * static_cast<std::size_t>(upTo(height));
  if (middles_.size() < most) {
    middles_ = gl::Buffer<std::array<float, 2>>("edge tiles", most);
    tiles_.attach(middles_.name(), {.location = POSITION_LOCATION, .components = 2, .stride = 8});
  }
  const std::array<std::uint32_t, 4> noPoints{0, 1, 0, 0};  // of glDrawArraysIndirect, in its order
  command_.upload(noPoints);
  middles_.bindStorage(EDGE_MIDDLES_BINDING);
  command_.bindStorage(EDGE_COMMAND_BINDING);
  programs.find.bind();
  glProgramUniform4i(programs.find.name(), EDGE_TILES_UNIFORM, left, bottom, right, top);
  gl::dispatch(static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(top - bottom),
               NORMALS_GROUP_SIZE, NORMALS_GROUP_SIZE);
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);

  programs.smooth.bind();
  tiles_.bind();
  command_.bindDraws();
  glEnable(GL_SCISSOR_TEST);
  glScissor(part.left, part.bottom, part.width(), part.height());
  glEnable(GL_PROGRAM_POINT_SIZE);
  glDrawArraysIndirect(GL_POINTS, nullptr);
  glDisable(GL_PROGRAM_POINT_SIZE);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace clothsim
