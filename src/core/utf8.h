// Characters of a text in UTF-8 (RFC 3629).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace clothsim {

struct Utf8Character {
  std::uint32_t code = 0;  // its code point; of a byte that is no UTF-8 the byte
  std::size_t bytes = 1;
  bool isValid = true;
};

// The character at the beginning of a text that is not empty.
[[nodiscard]] Utf8Character firstCharacter(std::string_view text);

// Whether the byte continues a character that began before it.
[[nodiscard]] inline bool continuesCharacter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

// The text without its last character; of no text, none.
[[nodiscard]] std::string_view withoutLastCharacter(std::string_view text);

}  // namespace clothsim
