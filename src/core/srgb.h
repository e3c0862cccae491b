// Colours as screens and files have them.
#pragma once

#include <cmath>

namespace clothsim {

// From sRGB (IEC 61966-2-1) to linear light, 0 to 1 each.
[[nodiscard]] inline double linearOfSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace clothsim
