// How a picture ends: edges are smoothed, exposures become their mean, and it gets the size that is shown.
#include <algorithm>
#include <array>
#include <cstdint>

#include "render/renderer_parts.h"

namespace clothsim {

void Renderer::Parts::finishInto(GLuint destination, int width, int height) {
  glDisable(GL_FRAMEBUFFER_SRGB);  // the shaders encode
  if (options.samples == 1)
    edges.smoothInto(destination, canvas, drawnPart(), programs.edges());
  else
    resolveInto(destination, width, height, programs.resolve, canvas.colorTexture());
}

void Renderer::Parts::addToMean(bool isFirst) {
  mean.bind();
  const std::array<float, 4> nothing{};
  if (isFirst) glClearNamedFramebufferfv(mean.name(), GL_COLOR, 0, nothing.data());
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glBindTextureUnit(CANVAS_UNIT, canvas.colorTexture());
  programs.mean().add.bind();
  noVertices.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
}

// `texture`: the canvas, or the mean.
void Renderer::Parts::resolveInto(GLuint destination, int width, int height, const gl::Program& resolve,
                                  GLuint texture) {
  glDisable(GL_FRAMEBUFFER_SRGB);  // the shader encodes
  glBindFramebuffer(GL_FRAMEBUFFER, destination);
  glViewport(0, 0, width, height);
  scissor();
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(CANVAS_UNIT, texture);
  resolve.bind();
  noVertices.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
}

// Only what has changed: copying what is kept costs a tenth of filtering it.
void Renderer::Parts::stretch() {
  const gl::FramebufferFormat& from = finished.format();
  const PictureSize to =
      isOver() ? drawnOver.size : PictureSize{stretched.format().width, stretched.format().height};
  PixelRect changed{0, 0, to.width, to.height};
  if (part) {
    // A pixel more on all sides, for the filter.
    const auto scaled = [](int at, int size, int toSize) {
      return std::clamp(static_cast<int>(static_cast<std::int64_t>(at) * toSize / size), 0, toSize);
    };
    changed = {scaled(part->picture.left - 1, from.width, to.width),
               scaled(part->picture.bottom - 1, from.height, to.height),
               scaled(part->picture.right + 2, from.width, to.width),
               scaled(part->picture.top + 2, from.height, to.height)};
  }
  if (isSoftware || isOver())
    return stretcher.run(finished, isOver() ? drawnOver.texture : stretched.colorTexture(), to, changed,
                         isOver());
  glEnable(GL_SCISSOR_TEST);
  glScissor(changed.left, changed.bottom, changed.width(), changed.height());
  glBlitNamedFramebuffer(finished.name(), stretched.name(), 0, 0, from.width, from.height, 0, 0, to.width,
                         to.height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::Parts::show(GLuint destination, int width, int height) const {
  glBlitNamedFramebuffer((stretchesApart() ? stretched : finished).name(), destination, 0, 0, width, height,
                         0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, destination);  // for what is drawn over the picture
  glViewport(0, 0, width, height);
}

}  // namespace clothsim
