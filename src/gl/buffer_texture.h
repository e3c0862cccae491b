// A buffer seen as a texture of one row, read by texelFetch: the same memory, on the path that every driver
// has made fast. (llvmpipe loads storage blocks lane by lane; fetching texels runs the step more than twice
// as fast there.)
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "gl/api.h"
#include "gl/bindings.h"

namespace clothsim::gl {

class BufferTexture {
 public:
  BufferTexture() = default;
  // `format` as glTextureBuffer takes it, GL_RGBA32F or GL_R32F. The buffer must live as long as the texture
  // is read.
  BufferTexture(const std::string& label, GLuint buffer, GLenum format) {
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &name_);
    glTextureBuffer(name_, format, buffer);
    glObjectLabel(GL_TEXTURE, name_, static_cast<GLsizei>(label.size()), label.c_str());
  }
  ~BufferTexture() {
    if (name_ != 0) glDeleteTextures(1, &name_);
  }
  BufferTexture(BufferTexture&& other) noexcept { std::swap(name_, other.name_); }
  BufferTexture& operator=(BufferTexture&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }

  // Shows that buffer from now on.
  void attach(GLuint buffer, GLenum format) const { glTextureBuffer(name_, format, buffer); }
  // Its first `bytes` alone, for shaders that ask for textureSize(): a buffer is longer than its elements.
  void attach(GLuint buffer, GLenum format, std::size_t bytes) const {
    glTextureBufferRange(name_, format, buffer, 0, static_cast<GLsizeiptr>(bytes));
  }

  void bind(GLuint unit) const {
    if (KeptBindings::changes(KeptBindings::Kind::texture, unit, {name_})) glBindTextureUnit(unit, name_);
  }

  // How many texels such a texture may have.
  [[nodiscard]] static std::size_t largestSize() {
    GLint64 texels = 0;
    glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    return static_cast<std::size_t>(texels);
  }

 private:
  GLuint name_ = 0;
};

}  // namespace clothsim::gl
