// One vec4 a particle: written through a storage block, read as texels.
#pragma once

#include <string>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "solver/state.h"

namespace clothsim {

struct ParticleArray {
  ParticleArray() = default;
  ParticleArray(const std::string& label, std::size_t count)
      : buffer(label, count), texture(label, buffer.name(), GL_RGBA32F) {}

  gl::Buffer<Particle4> buffer;
  gl::BufferTexture texture;
};

// @throws OpenGlError when so many elements do not fit into a buffer or a texture of this driver
void checkFits(std::size_t elements, std::size_t bytesEach, const char* what);

}  // namespace clothsim
