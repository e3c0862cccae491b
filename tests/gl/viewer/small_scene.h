#pragma once

#include "scene_io/scene_io.h"

namespace clothsim::test {

// Hangs by two corners.
inline Scene smallScene() {
  Scene scene = loadSceneByName("pinned2");
  (void)changeResolution(scene, 12, 12, true);
  return scene;
}

}  // namespace clothsim::test
