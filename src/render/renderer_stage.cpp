// What of a picture is its stage: the backdrop, and the ground and other planes.
#include <algorithm>
#include <cmath>

#include "render/renderer_parts.h"
#include "render/stage_look.h"

namespace clothsim {
namespace {

constexpr GLenum exposedBackdropFormat = GL_RGB10_A2;  // its slow gradients would show steps in 8 bits

}  // namespace

// One that does not turn with the camera is drawn once.
void Renderer::Parts::drawBackdrop(int width, int height) {
  const gl::FramebufferFormat format{
      .width = width, .height = height, .color = isExposed() ? exposedBackdropFormat : canvas.format().color};
  const bool turns = backdropTurns(scene->render);
  if (backdropSeen && backdrop.format() == format && !(turns && *backdropSeen != middleClipFromWorld)) return;
  if (!(backdrop.format() == format)) backdrop = gl::Framebuffer("backdrop", format);
  backdrop.bind();
  glDisable(GL_DEPTH_TEST);
  noVertices.bind();
  // The first one is drawn whole: while the camera rests, nobody waits for the programs of parts.
  const bool inParts = isSoftware && backdropSeen && !isExposed() && backdropShowsGround(scene->render);
  backdropSeen = middleClipFromWorld;
  if (!inParts) {
    programs.shaded(isExposed()).backdrop.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return;
  }
  glEnable(GL_SCISSOR_TEST);
  for (const auto& [pixels, shown] : backdropParts(frame, stageLook(scene->render.stage).groundShape)) {
    programs.backdropOf(shown).bind();
    glScissor(pixels.left, pixels.bottom, pixels.width(), pixels.height());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_SCISSOR_TEST);
}

// A copy where both are alike, which costs a software renderer a fiftieth of drawing it.
void Renderer::Parts::layBackdrop() {
  if (canvas.format().samples == 1 && !isExposed()) {
    const auto [left, bottom, right, top] = drawnPart();
    glBlitNamedFramebuffer(backdrop.name(), canvas.name(), left, bottom, right, top, left, bottom, right, top,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return;
  }
  canvas.bind();
  scissor();
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(BACKDROP_UNIT, backdrop.colorTexture());
  programs.shaded(isExposed()).layBackdrop.bind();
  noVertices.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
}

// Whether the backdrop shows it, too, as the eye sees it.
bool Renderer::Parts::isGroundBehind(const PlaneDisc& plane) const {
  return backdropShowsGround(scene->render) && frame.ground.w > 0 && plane.look.r < 0 &&
         plane.normal.y == 1 && std::abs(plane.place.y - frame.stagePlace.y) < 1e-5f * frame.stagePlace.w &&
         frame.eye.y > plane.place.y;
}

// The ground only under shadows, where those are known.
void Renderer::Parts::drawPlanes(const gl::Program& program) {
  if (!underShadows) return colliders.drawPlanes(program);
  glEnable(GL_SCISSOR_TEST);
  const auto drawIn = [&](std::size_t number, const PixelRect& drawn) {
    if (drawn.width() == 0 || drawn.height() == 0) return;
    glScissor(drawn.left, drawn.bottom, drawn.width(), drawn.height());
    colliders.drawPlane(program, number);
  };
  for (std::size_t i = 0; i < colliders.discs().size(); ++i) {
    if (!isGroundBehind(colliders.discs()[i])) {
      drawIn(i, drawnPart());
      continue;
    }
    for (const PixelRect& band : underShadows->bands()) drawIn(i, common(band, drawnPart()));
  }
  glDisable(GL_SCISSOR_TEST);
  scissor();
}

}  // namespace clothsim
