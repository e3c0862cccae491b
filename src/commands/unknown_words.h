// Words of a command line that the program does not know.
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

}  // namespace clothsim
