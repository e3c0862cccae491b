#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.h"

namespace clothsim {

// How messages name a cloth, as --set takes it: "cloth" where a scene has one, "cloths.1" where it has
// several.
[[nodiscard]] inline std::string nameOfCloth(const Scene& scene, std::size_t number) {
  return scene.cloths.size() == 1 ? "cloth" : "cloths." + std::to_string(number);
}

}  // namespace clothsim
