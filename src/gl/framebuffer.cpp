#include "gl/framebuffer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "core/error.h"

namespace clothsim::gl {
namespace {

// As windows are. What is stored alike a software renderer copies as memory; everything else it draws, which
// takes several times as long. Mesa orders colours as in the pixels it is given only where the internal
// format names no sizes.
void storeBlueFirst(GLuint texture, int width, int height) {
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  glTextureParameteri(texture, GL_TEXTURE_MAX_LEVEL, 0);
}

}  // namespace

Framebuffer::Framebuffer(const std::string& label, const FramebufferFormat& format) : format_(format) {
  glCreateFramebuffers(1, &name_);
  glObjectLabel(GL_FRAMEBUFFER, name_, static_cast<GLsizei>(label.size()), label.c_str());
  if (format.color != 0) {
    color_ = makeTexture(label + " color", format.color);
    glNamedFramebufferTexture(name_, GL_COLOR_ATTACHMENT0, color_, 0);
  } else {
    glNamedFramebufferDrawBuffer(name_, GL_NONE);
    glNamedFramebufferReadBuffer(name_, GL_NONE);
  }
  if (format.depth != 0) {
    depth_ = makeTexture(label + " depth", format.depth);
    glNamedFramebufferTexture(name_, GL_DEPTH_ATTACHMENT, depth_, 0);
  }
  const GLenum status = glCheckNamedFramebufferStatus(name_, GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  // The destructor does not run for an object that was never constructed.
  Framebuffer discarded;
  swap(discarded);
  throw OpenGlError("The framebuffer '" + label + "' of " + std::to_string(format.width) + " x " +
                    std::to_string(format.height) + " pixels with " + std::to_string(format.samples) +
                    " samples is not supported by the driver (status " + std::to_string(status) + ")");
}

Framebuffer::~Framebuffer() {
  if (color_ != 0) glDeleteTextures(1, &color_);
  if (depth_ != 0) glDeleteTextures(1, &depth_);
  if (name_ != 0) glDeleteFramebuffers(1, &name_);
}

void Framebuffer::swap(Framebuffer& other) {
  std::swap(name_, other.name_);
  std::swap(color_, other.color_);
  std::swap(depth_, other.depth_);
  std::swap(format_, other.format_);
}

GLuint Framebuffer::makeTexture(const std::string& label, GLenum internalFormat) const {
  GLuint texture = 0;
  if (format_.samples > 1) {
    glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &texture);
    glTextureStorage2DMultisample(texture, format_.samples, internalFormat, format_.width, format_.height,
                                  GL_TRUE);
  } else {
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    internalFormat == GL_RGBA8
        ? storeBlueFirst(texture, format_.width, format_.height)
        : glTextureStorage2D(texture, 1, internalFormat, format_.width, format_.height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  glObjectLabel(GL_TEXTURE, texture, static_cast<GLsizei>(label.size()), label.c_str());
  return texture;
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, name_);
  glViewport(0, 0, format_.width, format_.height);
}

void Framebuffer::resolveInto(const Framebuffer& target) const {
  assert(target.format_.width == format_.width && target.format_.height == format_.height &&
         "a resolve does not scale");
  glBlitNamedFramebuffer(name_, target.name_, 0, 0, format_.width, format_.height, 0, 0, format_.width,
                         format_.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

std::vector<std::uint8_t> Framebuffer::readRgb() const {
  assert(format_.samples <= 1 && "resolve a multisampled framebuffer before reading it");
  const std::size_t rowBytes = 3 * static_cast<std::size_t>(format_.width);
  const std::size_t rows = static_cast<std::size_t>(format_.height);
  std::vector<std::uint8_t> pixels(rowBytes * rows);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, name_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, format_.width, format_.height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  // OpenGL's first row is the bottom one.
  for (std::size_t row = 0; row < rows / 2; ++row) {
    const auto upper = pixels.begin() + static_cast<std::ptrdiff_t>(row * rowBytes);
    const auto lower = pixels.begin() + static_cast<std::ptrdiff_t>((rows - 1 - row) * rowBytes);
    std::swap_ranges(upper, upper + static_cast<std::ptrdiff_t>(rowBytes), lower);
  }
  return pixels;
}

int supportedSamples(int wanted) {
  // In descending order; one alone is always possible, and not in the list.
  std::array<GLint, 16> counts{};
  for (const GLenum format : {GL_RGBA8, GL_DEPTH_COMPONENT24}) {
    GLint length = 0;
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, format, GL_NUM_SAMPLE_COUNTS, 1, &length);
    length = std::min(length, static_cast<GLint>(counts.size()));
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, format, GL_SAMPLES, length, counts.data());
    const auto end = counts.begin() + length;
    const auto best = std::find_if(counts.begin(), end, [&](GLint count) { return count <= wanted; });
    wanted = best == end ? 1 : *best;
  }
  return wanted;
}

void Framebuffer::showColumns(int from) const {
  glBlitNamedFramebuffer(name_, 0, from, format_.height, format_.width, 0, from, 0, format_.width,
                         format_.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void bindFramebuffer(GLuint name) { glBindFramebuffer(GL_FRAMEBUFFER, name); }

}  // namespace clothsim::gl
