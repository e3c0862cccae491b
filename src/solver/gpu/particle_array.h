// One vec4 a particle: written through a storage block, read as texels.
#pragma once

#include <string>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "solver/state.h"

namespace clothsim {

// @throws OpenGlError when so many elements, of a texel each, do not fit into a storage block or a texture of
// this driver
void checkFits(std::size_t elements, std::size_t bytesEach, const char* what);
// For what passes only read: a storage block may be smaller. @throws OpenGlError
void checkTexelsFit(std::size_t texels, const char* what);

struct ParticleArray {
  ParticleArray() = default;
  // @throws OpenGlError when it does not fit into a block or a texture of this driver
  ParticleArray(const std::string& label, std::size_t count);

  gl::Buffer<Particle4> buffer;
  gl::BufferTexture texture;
};

}  // namespace clothsim
