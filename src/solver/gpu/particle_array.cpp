#include "solver/gpu/particle_array.h"

#include <algorithm>

#include "core/error.h"
#include "gl/context.h"

namespace clothsim {

namespace {

void checkAtMost(std::size_t largest, std::size_t elements, const char* what) {
  if (elements <= largest) return;
  throw OpenGlError("this cloth needs " + std::to_string(elements) + " " + what +
                    " in one buffer, and this driver allows " + std::to_string(largest) +
                    ". Use a smaller --resolution, or --backend cpu.");
}

}  // namespace

void checkFits(std::size_t elements, std::size_t bytesEach, const char* what) {
  const auto blockBytes = static_cast<std::size_t>(gl::currentContextInfo().maxStorageBlockBytes);
  checkAtMost(std::min(blockBytes / bytesEach, gl::BufferTexture::largestSize()), elements, what);
}

void checkTexelsFit(std::size_t texels, const char* what) {
  checkAtMost(gl::BufferTexture::largestSize(), texels, what);
}

ParticleArray::ParticleArray(const std::string& label, std::size_t count) {
  checkFits(count, sizeof(Particle4), label.c_str());
  buffer = gl::Buffer<Particle4>(label, count);
  texture = gl::BufferTexture(label, buffer.name(), GL_RGBA32F);
}

}  // namespace clothsim
