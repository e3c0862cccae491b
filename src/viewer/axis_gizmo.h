// Three small axes in the corner of the picture: they turn with the camera, and a click on an end looks from
// there.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "render/camera.h"
#include "viewer/viewer_overlay.h"

namespace clothsim {

struct AxisEnd {
  int axis = 0;  // x, y, z
  bool positive = true;
  glm::vec2 place{0};  // in the picture, from its top left [pixels]
  float toViewer = 0;  // -1 to 1: how far it points out of the picture
};

// The farthest first. `em` is the height of a line of text [pixels].
[[nodiscard]] std::array<AxisEnd, 6> axisEnds(const Camera& camera, PictureArea area, float em);

// The nearest end whose mark covers the place [pixels from the top left].
[[nodiscard]] std::optional<AxisEnd> axisEndAt(const Camera& camera, PictureArea area, float em,
                                               glm::vec2 place);

// To be called between UiFrame::begin() and end().
void drawAxes(const Camera& camera, PictureArea area);

}  // namespace clothsim
