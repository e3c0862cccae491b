// Three small axes in the corner of the picture: they turn with the camera, and a click on an end looks from
// there.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "render/camera.h"
#include "viewer/ui_frame.h"
#include "viewer/viewer_overlay.h"

namespace clothsim {

// Of x, y and z.
inline const std::array<ImVec4, 3> axisColors{
    {{0.86f, 0.37f, 0.40f, 1}, {0.50f, 0.74f, 0.36f, 1}, {0.36f, 0.58f, 0.90f, 1}}};

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
