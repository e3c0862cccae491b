// Makes foreign text safe to print on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace clothsim {

// Escapes what a terminal would act upon: control characters other than newline and tab, marks that reverse
// the direction of writing, and bytes that are no UTF-8 are written as \x1b or \u202e. Lines longer than 2000
// bytes lose their middle.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace clothsim
