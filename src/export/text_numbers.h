// Numbers as text: std::to_chars with nine significant digits, which is printf's %.9g in the C locale and
// enough to read every binary32 back exactly.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace clothsim {

inline void appendNumber(std::string& text, float value) {
  std::array<char, 32> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 9).ptr;
  text.append(digits.data(), end);
}

inline void appendIndex(std::string& text, std::size_t value) {
  std::array<char, 24> digits;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

}  // namespace clothsim
