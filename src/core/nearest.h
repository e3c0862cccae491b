// "Did you mean ...?": the known word nearest to one that was mistyped.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace clothsim {

// Edits (insert, delete, replace, swap two neighbours) that turn `a` into `b`; upper and lower case, '-' and
// '_' count as equal.
[[nodiscard]] int editDistance(std::string_view a, std::string_view b);

// The candidate with the fewest edits, the first of several; none when even that one differs in more than
// about a third of its letters. A word of at least three letters that begins a candidate counts as one edit
// away from it.
[[nodiscard]] std::optional<std::string> nearestWord(std::string_view word,
                                                     std::span<const std::string> candidates);

// "; did you mean \"damping\"?", or an empty string when nothing is near.
[[nodiscard]] std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

}  // namespace clothsim
