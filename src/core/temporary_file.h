// A new file that takes its name when it is complete: until then it has a name that nobody can foresee, in
// the same folder.
#pragma once

#include <sys/types.h>

#include <filesystem>

#include "core/error.h"

namespace clothsim {

[[nodiscard]] InputOutputError cannotBeWritten(const std::filesystem::path& path, int errorNumber);

// Where an ordinary write to a path goes: through symbolic links, also through one to a file that is not
// there.
struct Destination {
  std::filesystem::path file;
  bool isReplaced = true;  // false for /dev/null and its kind, which are written to directly
  bool exists = false;
  mode_t permissions = 0666;  // of the file that is there, or of a new one before the umask
};
// @throws InputOutputError naming `path`: a folder, a name too long, links in a circle, a file that is
// write-protected
[[nodiscard]] Destination destinationOf(const std::filesystem::path& path);

class TemporaryFile {
 public:
  // `path` names the file in messages. @throws InputOutputError, as publish() does
  TemporaryFile(std::filesystem::path path, Destination destination);
  ~TemporaryFile();  // without publish(): nothing is left of it
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  // Brings the content to the disk, then gives it the name, so that a power failure leaves the old file or
  // the new one.
  void publish();

 private:
  std::filesystem::path path_;
  Destination destination_;
  std::filesystem::path name_;  // "" once it has its own
  int descriptor_ = -1;
};

}  // namespace clothsim
