// Text of others, made fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace clothsim {

// The text without what a terminal would obey: control characters (but newline and tab), marks that reverse
// the direction of writing, and bytes that are no UTF-8 become \x1b or \u202e. Lines longer than 2000 bytes
// lose their middle.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace clothsim
