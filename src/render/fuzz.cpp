// Loose fibres of wool and the pile of velvet, as shells that lie over the cloth at several heights: J.
// Lengyel, E. Praun, A. Finkelstein, H. Hoppe, "Real-Time Fur over Arbitrary Surfaces", 2001.
#include <algorithm>
#include <cmath>

#include "render/renderer_parts.h"

namespace clothsim {
namespace {

constexpr double LEAST_SEEN = 0.3, ALL_SEEN = 1.0;  // of the fibres' length [pixels]
constexpr double SHELL_DISTANCE = 1.5;              // [pixels]
constexpr int FEWEST_SHELLS = 3, MOST_SHELLS = 12;
constexpr int EXPOSED_SHELLS = 4;  // of an exposure, whose shells lie between those of the others

}  // namespace

float Renderer::Parts::longestFuzz() const {
  double longest = 0;
  for (const PieceLook& look : looks) longest = std::max(longest, look.model.fuzz);
  return static_cast<float>(longest);
}

// From the cloth outwards. Fibres that are too short to be seen are left to the sheen (charlie.glsl).
void Renderer::Parts::drawFuzz(GLuint positions) {
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const PieceLook& look = looks[i];
    const double pixels = look.model.fuzz * pixelsAMetre;
    if (pixels < LEAST_SEEN) continue;
    const bool isOfAll = lookBlocks.empty();
    textures.bind(look.model);
    if (!isOfAll) lookBlocks[i].bindUniform(RENDER_FRAME_BINDING);
    const gl::Program& program =
        programs.fuzz(look.model, isExposed() ? ClothLight::exposed : ClothLight::atPixels);
    program.bind();
    const int shells = isExposed() ? EXPOSED_SHELLS
                                   : std::clamp(static_cast<int>(std::ceil(pixels / SHELL_DISTANCE)),
                                                FEWEST_SHELLS, MOST_SHELLS);
    const double seen = std::clamp((pixels - LEAST_SEEN) / (ALL_SEEN - LEAST_SEEN), 0.0, 1.0);
    for (int k = 0; k < shells; ++k) {
      glProgramUniform3f(program.name(), FUZZ_SHELL_UNIFORM, static_cast<float>((k + shellPlace) / shells),
                         1.0f / static_cast<float>(shells), static_cast<float>(seen));
      drawPieces(positions, smooth.has_value(), false, isOfAll ? std::nullopt : std::optional(i));
    }
    if (!isOfAll) frameBlock.bindUniform(RENDER_FRAME_BINDING);
  }
}

}  // namespace clothsim
