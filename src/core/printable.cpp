#include "core/printable.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace clothsim {

namespace {

constexpr std::size_t LONGEST_LINE = 2000, KEPT_BEGINNING = 1200, KEPT_END = 700;  // [bytes]

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool isValid = true;
};

// At the beginning of the text, which is not empty (RFC 3629).
Character firstCharacter(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {lead, 1, false};
  std::uint32_t code = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if (!continues(text[i])) return {lead, 1, false};
    code = code << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
  }
  const bool isOverlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  const bool exists = code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  return isOverlong || !exists ? Character{lead, 1, false} : Character{code, bytes, true};
}

bool isObeyed(std::uint32_t code) {
  const auto within = [&](std::uint32_t low, std::uint32_t high) { return low <= code && code <= high; };
  if (code == '\n' || code == '\t') return false;
  return code < 0x20 || within(0x7F, 0x9F) || within(0x200E, 0x200F) || within(0x2028, 0x202E) ||
         within(0x2066, 0x2069);
}

std::string escaped(std::string_view line) {
  std::string result;
  while (!line.empty()) {
    const Character c = firstCharacter(line);
    char escape[16];
    std::snprintf(escape, sizeof escape, c.code < 0x100 ? "\\x%02x" : "\\u%04x",
                  static_cast<unsigned>(c.code));
    result += !c.isValid || isObeyed(c.code) ? std::string_view(escape) : line.substr(0, c.bytes);
    line.remove_prefix(c.bytes);
  }
  return result;
}

// Cut between characters.
std::string shortened(const std::string& line) {
  if (line.size() <= LONGEST_LINE) return line;
  std::size_t beginning = KEPT_BEGINNING, end = line.size() - KEPT_END;
  while (continues(line[beginning])) --beginning;
  while (continues(line[end])) ++end;
  return line.substr(0, beginning) + " ... (" + std::to_string(end - beginning) + " bytes more) ... " +
         line.substr(end);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  for (;;) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += shortened(escaped(text.substr(0, end)));
    if (end == text.size()) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace clothsim
