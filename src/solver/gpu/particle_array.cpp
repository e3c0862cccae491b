#include "solver/gpu/particle_array.h"

#include <algorithm>

#include "core/error.h"
#include "gl/context.h"

namespace clothsim {

void checkFits(std::size_t elements, std::size_t bytesEach, const char* what) {
  const std::size_t largest =
      std::min(static_cast<std::size_t>(gl::currentContextInfo().maxStorageBlockBytes) / bytesEach,
               gl::BufferTexture::largestSize());
  if (elements <= largest) return;
  throw OpenGlError("this cloth needs " + std::to_string(elements) + " " + what +
                    " in one buffer, and this driver allows " + std::to_string(largest) +
                    ". Use a smaller --resolution, or --backend cpu.");
}

}  // namespace clothsim
