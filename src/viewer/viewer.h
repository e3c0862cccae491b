// The window in which a scene is simulated and played with.
#pragma once

#include <string>

#include "core/shared.h"
#include "scene/scene.h"

namespace clothsim {

struct ViewerOptions {
  std::string sceneName;          // for title and overlay
  std::string backend = "gpu";    // "gpu" or "cpu"; B changes it
  int sphereSegmentsAround = 64;  // -a
  int sphereSegmentsDown = 48;    // -o
  bool timings = false;           // says at the end where the time of a frame went
};

// Opens the window and returns when it is closed. @throws OpenGlError when there is no display or no
// OpenGL 4.5 (says what was found and which commands need neither)
void runViewer(const Shared<Scene>& scene, const ViewerOptions& options);

// The table of viewer_keys.h as lines for `--help`.
[[nodiscard]] std::string viewerKeysText();

}  // namespace clothsim
