#include "core/utf8.h"

namespace clothsim {

Utf8Character firstCharacter(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {lead, 1, false};
  std::uint32_t code = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if (!continuesCharacter(text[i])) return {lead, 1, false};
    code = code << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
  }
  const bool isOverlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  const bool exists = code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  return isOverlong || !exists ? Utf8Character{lead, 1, false} : Utf8Character{code, bytes, true};
}

std::string_view withoutLastCharacter(std::string_view text) {
  std::size_t end = text.size();
  while (end > 1 && continuesCharacter(text[end - 1])) --end;
  return text.substr(0, end == 0 ? 0 : end - 1);
}

}  // namespace clothsim
