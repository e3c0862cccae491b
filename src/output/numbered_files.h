// File names for screenshots, clips and recordings: scene-backend-frame.png, with a number added where a file
// has that name.
#pragma once

#include <filesystem>
#include <string>

namespace clothsim {

// The folder for the viewer's files: the current one; where it is not writable, the user's folder of pictures
// or the home folder.
[[nodiscard]] std::filesystem::path outputFolder();

// The first name without a file: folder/stem.extension, or with -2, -3 ... after the stem.
[[nodiscard]] std::filesystem::path freeName(const std::filesystem::path& folder, const std::string& stem,
                                             const std::string& extension);

}  // namespace clothsim
