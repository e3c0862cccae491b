// A scene as its text in a test.
#pragma once

#include <string>

#include "scene_io/scene_io.h"

namespace clothsim::test {

inline Scene sceneOf(const std::string& text) { return parseScene(text, "test"); }

}  // namespace clothsim::test
