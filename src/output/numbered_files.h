// Names for screenshots, clips and recordings: scene-backend-frame.png, with a number added where that name
// is taken.
#pragma once

#include <filesystem>
#include <string>

namespace clothsim {

// The folder for what the viewer writes on request: the current one, or the user's pictures or home folder
// where that cannot be written to.
[[nodiscard]] std::filesystem::path outputFolder();

// folder/stem.extension, or with -2, -3 ... behind the stem: the first name that nothing has.
[[nodiscard]] std::filesystem::path freeName(const std::filesystem::path& folder, const std::string& stem,
                                             const std::string& extension);

}  // namespace clothsim
