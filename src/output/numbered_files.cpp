#include "output/numbered_files.h"

#include <unistd.h>

#include <cstdlib>

namespace clothsim {

namespace fs = std::filesystem;

namespace {

bool canWriteIn(const fs::path& folder) { return ::access(folder.c_str(), W_OK | X_OK) == 0; }

}  // namespace

fs::path outputFolder() {
  if (canWriteIn(".")) return ".";
  if (const char* pictures = std::getenv("XDG_PICTURES_DIR"); pictures != nullptr && canWriteIn(pictures))
    return pictures;
  if (const char* home = std::getenv("HOME"); home != nullptr) {
    const fs::path pictures = fs::path(home) / "Pictures";
    return canWriteIn(pictures) ? pictures : fs::path(home);
  }
  return ".";
}

fs::path freeName(const fs::path& folder, const std::string& stem, const std::string& extension) {
  const auto isTaken = [](const fs::path& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(
        path, ignored));  // a name that is too long counts as free; writing it fails with a message
  };
  fs::path path = folder / (stem + extension);
  for (int number = 2; isTaken(path); ++number)
    path = folder / (stem + "-" + std::to_string(number) + extension);
  return path.lexically_normal();
}

}  // namespace clothsim
