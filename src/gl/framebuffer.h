// An off-screen framebuffer with textures as attachments: colour with depth, multisampled or not, or depth
// alone (for shadow maps); move-only.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gl/api.h"

namespace clothsim::gl {

struct FramebufferFormat {
  int width = 0, height = 0;  // [pixels]
  int samples = 1;            // more than 1: multisampled
  GLenum color = 0;           // internal format; 0: no colour
  GLenum depth = 0;           // internal format; 0: no depth
  friend bool operator==(const FramebufferFormat&, const FramebufferFormat&) = default;
};

class Framebuffer {
 public:
  Framebuffer() = default;
  // @throws OpenGlError when the driver cannot make one of this format
  Framebuffer(const std::string& label, const FramebufferFormat& format);
  ~Framebuffer();
  Framebuffer(Framebuffer&& other) noexcept { swap(other); }
  Framebuffer& operator=(Framebuffer&& other) noexcept {
    swap(other);
    return *this;
  }

  [[nodiscard]] GLuint name() const { return name_; }
  [[nodiscard]] GLuint colorTexture() const { return color_; }  // GL_TEXTURE_2D_MULTISAMPLE when samples > 1
  [[nodiscard]] GLuint depthTexture() const { return depth_; }
  [[nodiscard]] const FramebufferFormat& format() const { return format_; }

  void bind() const;  // for drawing, with the viewport over all of it
  // Copies columns `from` to the last into the lower left of the window. The top row comes first here, as in
  // a window: a software renderer would have to draw other pictures.
  void showColumns(int from) const;
  // Averages the samples of the colour into `target`, which has the same size and format and is not
  // multisampled.
  void resolveInto(const Framebuffer& target) const;
  // 3 bytes a pixel, top row first; waits for the GPU. Not for a multisampled framebuffer.
  [[nodiscard]] std::vector<std::uint8_t> readRgb() const;

 private:
  void swap(Framebuffer& other);
  [[nodiscard]] GLuint makeTexture(const std::string& label, GLenum internalFormat) const;

  GLuint name_ = 0, color_ = 0, depth_ = 0;
  FramebufferFormat format_;
};

// The most samples a pixel, up to `wanted`, that colour and depth attachments really have: a driver may round
// up what it is asked for, and llvmpipe makes 4 of 2.
[[nodiscard]] int supportedSamples(int wanted);
// To draw into it; 0: the window.
void bindFramebuffer(GLuint name);

}  // namespace clothsim::gl
