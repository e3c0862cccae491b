// Where arrays begin in memory: a vector register's load or store that crosses from one line of the cache to
// the next takes twice as long.
#pragma once

#include <cstddef>
#include <cstdint>

namespace clothsim {

inline constexpr std::size_t CACHE_LINE = 64;  // [B]

// Numbers of a type in a line.
template <class Number>
inline constexpr std::size_t LINE_NUMBERS = CACHE_LINE / sizeof(Number);

// The first line that begins at `values` or behind, less than a line away.
template <class Number>
[[nodiscard]] Number* lineAt(Number* values) {
  const auto address = reinterpret_cast<std::uintptr_t>(values);
  return values + (CACHE_LINE - address % CACHE_LINE) % CACHE_LINE / sizeof(Number);
}

}  // namespace clothsim
