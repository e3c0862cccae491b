#include "viewer/kept_picture.h"

namespace clothsim {

const gl::Framebuffer& KeptPicture::drawInto(int width, int height) {
  forget();
  const gl::FramebufferFormat format{.width = width, .height = height, .color = GL_RGBA8};
  if (!(picture_.format() == format)) picture_ = gl::Framebuffer("picture", format);
  return picture_;
}

}  // namespace clothsim
