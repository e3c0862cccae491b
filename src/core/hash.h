// Integer hashes: PCG for repeatable randomness, FNV-1a for fingerprints of state.
#pragma once

#include <cstddef>
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

// FNV-1a, 64 bit (Fowler, Noll, Vo).
class Fnv1a {
 public:
  constexpr void addByte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3ull; }
  constexpr void addWord(std::uint32_t word) {  // little-endian
    for (int shift = 0; shift < 32; shift += 8) addByte(static_cast<std::uint8_t>(word >> shift));
  }
  [[nodiscard]] constexpr std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace clothsim
