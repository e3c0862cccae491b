// What the mouse acts on.
#pragma once

#include <functional>

#include "viewer/open_scene.h"
#include "viewer/picture_places.h"

namespace clothsim {

// The scene under the mouse, shown in a picture of that size [pixels].
struct MouseContext {
  OpenScene& open;
  SimulationRenderer& renderer;
  Camera& camera;
  int width, height;
  float em;  // the height of a line of text [pixels]
  bool paused;
  // Session::act(), now or at the end of the frame that is being simulated.
  std::function<void(const Action& action, bool continues)> act;

  [[nodiscard]] PictureView view() const {
    return {camera, static_cast<float>(width), static_cast<float>(height)};
  }
};

}  // namespace clothsim
