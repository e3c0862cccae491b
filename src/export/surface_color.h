// Colours and roughness of materials as USD and glTF define them.
#pragma once

#include "core/srgb.h"
#include "scene/scene.h"

namespace clothsim {

// Linear in intensity, of sRGB.
[[nodiscard]] inline Vec3d linearFromSrgb(Vec3d color) {
  return {linearOfSrgb(color.x), linearOfSrgb(color.y), linearOfSrgb(color.z)};
}

[[nodiscard]] inline double clothRoughness(const RenderSettings& look) { return 1 - 0.7 * look.gloss; }

}  // namespace clothsim
