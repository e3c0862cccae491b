// The window in which a scene is simulated and a user acts on it.
#pragma once

#include <string>

#include "core/shared.h"
#include "scene/scene.h"

namespace clothsim {

struct ViewerOptions {
  std::string sceneName;          // for the title and the overlay
  std::string backend = "auto";   // "auto", "gpu" or "cpu"; the key B changes it
  int sphereSegmentsAround = 64;  // -a
  int sphereSegmentsDown = 48;    // -o
  bool timings = false;           // prints the times of a frame's phases at the end
  std::string quality = "auto";   // "auto", "draft", "normal" or "final"; the key Q changes it
  double restartAfter = 0;        // [s] of simulated time, until the cloth is touched or changed; 0: never
};

// Opens the window and returns when it is closed. @throws OpenGlError when there is no display or no
// OpenGL 4.5; its message tells which commands need neither
void runViewer(const Shared<Scene>& scene, const ViewerOptions& options);

// The table in viewer_keys.h as lines for `--help`.
[[nodiscard]] std::string viewerKeysText();

}  // namespace clothsim
