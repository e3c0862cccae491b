// Numbers as text for panels and labels.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace clothsim {

// By printf's rules; 255 characters at most.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace clothsim
