// Between the world and places in the picture.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "core/vec.h"
#include "render/camera.h"
#include "render/stage.h"

namespace clothsim {

// What a picture of that size shows [pixels].
struct PictureView {
  const Camera& camera;
  float width = 1, height = 1;
};

// The ray from the eye through a place of the picture [pixels from the top left]; its direction has length 1.
struct ViewRay {
  glm::vec3 origin, direction;
};
[[nodiscard]] ViewRay rayThrough(const PictureView& view, glm::vec2 place);
// The place of a point of the world in the picture [pixels from the top left]; none behind the eye.
[[nodiscard]] std::optional<glm::vec2> placeInPicture(const PictureView& view, glm::vec3 point);
// How long a pixel is at a point of the world, across the view [m]; 0 behind the eye.
[[nodiscard]] float pixelSizeAt(const PictureView& view, glm::vec3 point);

}  // namespace clothsim
