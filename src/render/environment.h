// The generated sky, or the surroundings of a stage, as light: what a mirror shows, and how bright a matte
// surface is that faces any way.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "gl/texture.h"
#include "render/textures.h"

namespace clothsim {

class Environment {
 public:
  // Reads assets/textures/sky.png. @throws InputOutputError
  Environment();
  // Of a stage with surroundings of its own: a ceiling, walls, a ground, and a window or lamps where the main
  // light comes from.
  Environment(std::string_view stage, glm::vec3 toKey);

  // Linear light that comes from a unit direction.
  [[nodiscard]] glm::vec3 lightFrom(glm::vec3 direction) const;

  // Irradiance over pi as a polynomial of second degree in the normal n: the sum of its terms times
  // (1, x, y, z, x y, y z, z x, z z, x x - y y). After R. Ramamoorthi and P. Hanrahan, "An efficient
  // representation for irradiance environment maps", 2001.
  [[nodiscard]] std::array<glm::vec3, 9> irradiance() const;

  [[nodiscard]] gl::Texture makeCubeMap() const;

 private:
  int width_, height_;
  std::vector<glm::vec3> light_;  // equirectangular, from the zenith down; the middle column looks along +z
};

// Whether a stage has surroundings of its own; the others are under the sky.
[[nodiscard]] bool hasSurroundings(std::string_view stage);

}  // namespace clothsim
