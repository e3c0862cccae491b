// Colours and roughness of materials as USD and glTF define them.
#pragma once

#include <cmath>

#include "scene/scene.h"

namespace clothsim {

// Linear in intensity, of sRGB.
[[nodiscard]] inline Vec3d linearFromSrgb(Vec3d color) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return {linear(color.x), linear(color.y), linear(color.z)};
}

[[nodiscard]] inline double clothRoughness(const RenderSettings& look) { return 1 - 0.7 * look.gloss; }

}  // namespace clothsim
