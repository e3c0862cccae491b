// A texture with its mipmaps, filled once, by direct state access; move-only.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <utility>

#include "gl/api.h"
#include "gl/bindings.h"

namespace clothsim::gl {

// How pixels are given and kept: as glTextureStorage2D and glTextureSubImage2D take it.
struct PixelFormat {
  GLenum internal = GL_RGBA8, given = GL_RGBA, type = GL_UNSIGNED_BYTE;
};

class Texture {
 public:
  Texture() = default;
  // `pixels` row by row, without padding. Repeats beyond its sides.
  [[nodiscard]] static Texture make2D(const std::string& label, int width, int height,
                                      const PixelFormat& format, const void* pixels) {
    Texture texture(GL_TEXTURE_2D, label, width, height, format.internal);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.name_, 0, 0, 0, width, height, format.given, format.type, pixels);
    texture.finish(GL_REPEAT);
    return texture;
  }
  // Faces in OpenGL's order: +x, -x, +y, -y, +z, -z, each `size` x `size` pixels.
  [[nodiscard]] static Texture makeCube(const std::string& label, int size, const PixelFormat& format,
                                        const std::array<const void*, 6>& faces) {
    Texture texture(GL_TEXTURE_CUBE_MAP, label, size, size, format.internal);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (GLint face = 0; face < 6; ++face)
      glTextureSubImage3D(texture.name_, 0, 0, 0, face, size, size, 1, format.given, format.type,
                          faces[static_cast<std::size_t>(face)]);
    texture.finish(GL_CLAMP_TO_EDGE);
    return texture;
  }
  ~Texture() {
    if (name_ != 0) glDeleteTextures(1, &name_);
  }
  Texture(Texture&& other) noexcept { std::swap(name_, other.name_); }
  Texture& operator=(Texture&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }

  [[nodiscard]] GLuint name() const { return name_; }
  void bind(GLuint unit) const {
    if (KeptBindings::changes(KeptBindings::Kind::texture, unit, {name_})) glBindTextureUnit(unit, name_);
  }

 private:
  Texture(GLenum target, const std::string& label, int width, int height, GLenum internal) {
    glCreateTextures(target, 1, &name_);
    const int levels = std::bit_width(static_cast<unsigned>(std::max(width, height)));
    glTextureStorage2D(name_, levels, internal, width, height);
    glObjectLabel(GL_TEXTURE, name_, static_cast<GLsizei>(label.size()), label.c_str());
  }
  void finish(GLint wrap) const {
    glGenerateTextureMipmap(name_);
    glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name_, GL_TEXTURE_WRAP_S, wrap);
    glTextureParameteri(name_, GL_TEXTURE_WRAP_T, wrap);
  }

  GLuint name_ = 0;
};

}  // namespace clothsim::gl
