// Words of a command line that the program does not know, and words that are none.
#pragma once

#include <span>
#include <string>

namespace CLI {
class App;
}

namespace clothsim {

// A sentence about the first option or command of `words` (without the program's name) that `app` does not
// know, or that stands in the wrong place, with what may be meant. Empty if there is none. CLI11 lists such
// words backwards, without a proposal, and not at all where something required is missing.
[[nodiscard]] std::string unknownWord(const CLI::App& app, std::span<const char* const> words);

// Makes "" wrong usage as the value of any option that the app and its commands have: it comes from a
// variable of a script that is not set, and would pass for an option that is not given.
void refuseEmptyValues(CLI::App& app);

}  // namespace clothsim
