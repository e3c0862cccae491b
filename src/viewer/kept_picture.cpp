#include "viewer/kept_picture.h"

namespace clothsim {

GLuint KeptPicture::drawInto(int width, int height) {
  forget();
  const gl::FramebufferFormat format{.width = width, .height = height, .color = GL_RGBA8};
  const GLuint shown = gl::boundFramebuffer();
  if (!(picture_.format() == format)) picture_ = gl::Framebuffer("picture", format);
  gl::bindFramebuffer(shown);
  return picture_.name();
}

}  // namespace clothsim
