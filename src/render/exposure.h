// A final picture is the mean of exposures, each a whole picture from a slightly other place in the pixel and
// on the lens, with light from another point of the main light's disc and other directions of the sky: so
// edges, shadows, depth of field and the shade where surfaces meet come out as they are, without noise to
// filter.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "shared/render_layout.h"

namespace clothsim {

struct Exposure {
  glm::vec2 pixel{0};  // where in the picture, off the middles of its pixels, -1 to 1 [pixels]
  glm::vec2 lens{0};   // within the unit disc
  glm::vec2 light{0};  // the same
  std::array<glm::vec3, SKY_DIRECTIONS> sky{};  // unit
  double time = 0;  // from the middle of the time that the shutter is open, -1/2 to 1/2 of it
};

// `count` of them, > 0: each two numbers evenly spread (M. Roberts, "The Unreasonable Effectiveness of
// Quasirandom Sequences", 2018), in an order of their own so that they have nothing to do with each other. In
// the pixel they follow a tent two pixels wide. The same every time.
[[nodiscard]] std::vector<Exposure> makeExposures(int count);

// From the scene to the point of the main light that shines, where `toLight` is the direction to its middle
// and `degrees` the angle across it.
[[nodiscard]] glm::vec3 directionToLight(const Exposure& exposure, glm::vec3 toLight, double degrees);

// What the camera sees from the point of a lens of that diameter [m], in its own frame: what is at the
// distance of focus [m] stays in its place of the picture.
[[nodiscard]] glm::mat4 viewThroughLens(const Exposure& exposure, double aperture, double focus);

}  // namespace clothsim
