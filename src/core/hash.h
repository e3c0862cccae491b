// An integer hash for repeatable randomness: the same number for the same seed and index, everywhere.
#pragma once

#include <cstdint>

namespace clothsim {

// PCG-RXS-M-XS, 32 bit (Jarzynski and Olano, "Hash Functions for GPU Rendering", 2020, section 4).
[[nodiscard]] constexpr std::uint32_t pcg(std::uint32_t input) {
  const std::uint32_t state = input * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// Uniform in [0, 1) from a seed and an index.
[[nodiscard]] constexpr double uniform01(std::uint32_t seed, std::uint32_t index) {
  return static_cast<double>(pcg(pcg(seed) + index)) * 0x1p-32;
}

}  // namespace clothsim
