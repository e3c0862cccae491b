// FNV-1a, the 64 bit hash by which states are compared and files checked (Fowler, Noll, Vo;
// draft-eastlake-fnv).
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace clothsim {

class Fnv1a {
 public:
  constexpr void add(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3u; }
  constexpr void add(std::string_view bytes) {
    for (const char c : bytes) add(static_cast<std::uint8_t>(c));
  }
  // The four bytes of its binary32 pattern, lowest first, whatever the machine's own order.
  constexpr void add(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int shift = 0; shift < 32; shift += 8) add(static_cast<std::uint8_t>(bits >> shift));
  }
  [[nodiscard]] constexpr std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace clothsim
