// A picture in memory: 8 bit RGB, sRGB, top row first.
#pragma once

#include <cstdint>
#include <vector>

namespace clothsim {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height
};

}  // namespace clothsim
