// A file that takes its name when it is complete. Until then it has an unpredictable name in the same folder.
#pragma once

#include <sys/types.h>

#include <filesystem>

#include "core/error.h"

namespace clothsim {

[[nodiscard]] InputOutputError cannotBeWritten(const std::filesystem::path& path, int errorNumber);

// Where an ordinary write to a path ends up: it follows symbolic links, also one to a file that does not
// exist.
struct Destination {
  std::filesystem::path file;
  bool isReplaced = true;  // false for /dev/null and its kind, which are written to directly
  bool exists = false;
  mode_t permissions = 0666;  // of the file that is there, or of a new one before the umask
};
// @throws InputOutputError naming `path`, for a folder, a name that is too long, links in a circle, or a file
// that is write-protected
[[nodiscard]] Destination destinationOf(const std::filesystem::path& path);

class TemporaryFile {
 public:
  // `path` names the file in messages. @throws InputOutputError, as publish() does
  TemporaryFile(std::filesystem::path path, Destination destination);
  ~TemporaryFile();  // Without publish() the file is removed.
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  // Flushes the content to the disk, then renames the file: after a power failure there is the old file or
  // the new one, each whole.
  void publish();
  // Takes the file's name away: its content lasts as long as this does, even if the program is killed.
  void removeName();

 private:
  std::filesystem::path path_;
  Destination destination_;
  std::filesystem::path name_;  // empty once the file has its own name
  int descriptor_ = -1;
};

}  // namespace clothsim
