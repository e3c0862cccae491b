// The binary form of USD (.usdc, and .usd, which may be either), made of the text form by Pixar's library,
// where the Python on this machine has it.
#pragma once

#include <filesystem>

#include "core/files.h"

namespace clothsim {

[[nodiscard]] bool isUsdBinary(const std::filesystem::path& path);

// $CLOTHSIM_PYTHON, or python3, must have the library. @throws InputOutputError that says how to get it
void checkUsdLibrary(const std::filesystem::path& path);

// Reads text from the descriptor and writes the binary form to `file`, which becomes `path`.
// @throws InputOutputError
void makeUsdBinary(const std::filesystem::path& path, int text, GrowingFile& file);

}  // namespace clothsim
