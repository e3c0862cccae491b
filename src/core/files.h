// Files read and written whole or not at all, and where the program finds its own shaders and assets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/temporary_file.h"

namespace clothsim {

// Reads regular files only: a pipe or a device could keep the program waiting for ever.
// @throws InputOutputError naming the path and the reason, also when the file is larger than `largest` bytes
[[nodiscard]] std::string readFile(const std::filesystem::path& path, std::uintmax_t largest = UINTMAX_MAX);

// Writes to a temporary name beside `path`, then renames: the old file stays until the new one is complete,
// and a failure leaves no half file. @throws InputOutputError
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

// A file that grows piece by piece under a temporary name beside `path`, and takes the name when it is
// complete; /dev/null and its kind are written to directly.
// @throws InputOutputError, from every function
class GrowingFile {
 public:
  explicit GrowingFile(const std::filesystem::path& path);
  ~GrowingFile();  // Without close() the file is removed.
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(std::string_view bytes);
  // Replaces bytes that were written before. append() still continues at the end.
  void overwrite(std::uint64_t offset, std::string_view bytes);
  void close();
  // For a program that writes the whole of it.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  void write(std::string_view bytes);

  std::filesystem::path path_;
  std::optional<TemporaryFile> temporary_;  // none for a device
  int descriptor_ = -1;                     // of the temporary file, or of a device, which we close
  std::string pending_;                     // collects small pieces, to write them together
};

// For commands that write at the end of long work: fails at once when no file could be made at `path`.
// @throws InputOutputError
void checkWritable(const std::filesystem::path& path);

// "frame_%04d.png" with 7 -> "frame_0007.png". Only the first %d or %0Nd is understood;
// hasFrameNumber tells whether there is one.
[[nodiscard]] bool hasFrameNumber(const std::string& pattern);
[[nodiscard]] std::string numberedName(const std::string& pattern, int frame);

// The user's folder for what this program keeps between runs: $XDG_CONFIG_HOME/clothsim or
// ~/.config/clothsim; empty where neither is set. It need not exist.
[[nodiscard]] std::filesystem::path userConfigFolder();
// Writes a file there, whole or not at all, and makes the folders. Returns why it could not, "" when it did.
[[nodiscard]] std::string saveInConfigFolder(const std::filesystem::path& path, std::string_view bytes);

// The folder that holds shaders/ and assets/: $CLOTHSIM_ROOT, else beside the executable or one of the
// folders above it, else the source tree it was built from. @throws InputOutputError when none has them
[[nodiscard]] const std::filesystem::path& resourceRoot();
// For a library in somebody else's program: the search begins at this folder instead of at the executable. To
// be called before resourceRoot().
void beginResourceSearchAt(const std::filesystem::path& folder);

// The same search from given places; `fromEnvironment` may be null. Beside a folder, <folder>/share/clothsim
// counts, too.
[[nodiscard]] std::filesystem::path findResourceRoot(const char* fromEnvironment,
                                                     const std::filesystem::path& executableFolder,
                                                     const std::filesystem::path& sourceRoot);

}  // namespace clothsim
