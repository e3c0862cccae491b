#include "core/printable.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "core/utf8.h"

namespace clothsim {

namespace {

constexpr std::size_t LONGEST_LINE = 2000, KEPT_BEGINNING = 1200, KEPT_END = 700;  // [bytes]

bool isObeyed(std::uint32_t code) {
  const auto within = [&](std::uint32_t low, std::uint32_t high) { return low <= code && code <= high; };
  if (code == '\n' || code == '\t') return false;
  return code < 0x20 || within(0x7F, 0x9F) || within(0x200E, 0x200F) || within(0x2028, 0x202E) ||
         within(0x2066, 0x2069);
}

std::string escaped(std::string_view line) {
  std::string result;
  while (!line.empty()) {
    const Utf8Character c = firstCharacter(line);
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
  while (continuesCharacter(line[beginning])) --beginning;
  while (continuesCharacter(line[end])) ++end;
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
