// Files read and written whole or not at all.
#include "core/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"

namespace clothsim {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

InputOutputError failure(const fs::path& path, const std::string& what, int code) {
  return InputOutputError(path.string() + ": " + what + ": " + std::strerror(code));
}

std::uintmax_t checkedSize(const fs::path& path, std::uintmax_t largest) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found) throw failure(path, "cannot be read", ENOENT);
  if (code) throw failure(path, "cannot be read", code.value());
  if (fs::is_directory(status)) throw InputOutputError(path.string() + ": is a folder, not a file");
  if (!fs::is_regular_file(status)) throw InputOutputError(path.string() + ": is not a regular file");
  const std::uintmax_t size = fs::file_size(path, code);
  if (code) throw failure(path, "cannot be read", code.value());
  if (size > largest)
    throw InputOutputError(path.string() + ": has " + std::to_string(size) +
                           " bytes, more than the limit of " + std::to_string(largest));
  return size;
}

struct FrameNumber {
  std::size_t begin, end;  // of "%04d" in the pattern
  int digits;
};

std::optional<FrameNumber> findFrameNumber(const std::string& pattern) {
  for (std::size_t begin = pattern.find('%'); begin != std::string::npos;
       begin = pattern.find('%', begin + 1)) {
    std::size_t at = begin + 1;
    int digits = 0;
    if (at < pattern.size() && pattern[at] == '0') {
      // Two digits of width are plenty; more would be a mistake, and could overflow.
      for (++at; at < pattern.size() && pattern[at] >= '0' && pattern[at] <= '9' && digits < 10; ++at)
        digits = digits * 10 + (pattern[at] - '0');
      if (digits == 0) continue;
    }
    if (at < pattern.size() && pattern[at] == 'd') return FrameNumber{begin, at + 1, digits};
  }
  return std::nullopt;
}

bool holdsResources(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "assets" / "scenes", ignored);
}

}  // namespace

std::string readFile(const fs::path& path, std::uintmax_t largest) {
  const std::uintmax_t size = checkedSize(path, largest);
  errno = 0;
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw failure(path, "cannot be read", errno);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (std::ferror(file.get()) != 0) throw failure(path, "cannot be read", errno);
  bytes.resize(count);
  return bytes;
}

GrowingFile::GrowingFile(const fs::path& path) : path_(path) {
  const Destination destination = destinationOf(path);
  if (destination.isReplaced)
    descriptor_ = temporary_.emplace(path, destination).descriptor();
  else
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) throw cannotBeWritten(path_, errno);
}

GrowingFile::~GrowingFile() {
  if (!temporary_ && descriptor_ >= 0) ::close(descriptor_);
}

void GrowingFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written > 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (written < 0 && errno == EINTR)
      stopIfInterrupted();
    else
      throw cannotBeWritten(path_, written < 0 ? errno : EIO);
  }
}

void GrowingFile::append(std::string_view bytes) {
  constexpr std::size_t worthWriting = 1 << 16;
  if (pending_.size() + bytes.size() < worthWriting) {
    pending_ += bytes;
    return;
  }
  write(std::exchange(pending_, {}));
  write(bytes);
}

void GrowingFile::overwrite(std::uint64_t offset, std::string_view bytes) {
  write(std::exchange(pending_, {}));
  if (::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0) throw cannotBeWritten(path_, errno);
  write(bytes);
  if (::lseek(descriptor_, 0, SEEK_END) < 0) throw cannotBeWritten(path_, errno);
}

void GrowingFile::close() {
  write(std::exchange(pending_, {}));
  if (temporary_)
    temporary_->publish();
  else if (::close(std::exchange(descriptor_, -1)) != 0)
    throw cannotBeWritten(path_, errno);
}

void writeFileAtomically(const fs::path& path, std::string_view bytes) {
  GrowingFile file(path);
  file.append(bytes);
  file.close();
}

void checkWritable(const fs::path& path) {
  const Destination destination = destinationOf(path);
  // Only a try tells for sure: a file system may be read-only, out of inodes, or at its limit of a name's
  // length.
  if (destination.isReplaced) TemporaryFile(path, destination);
}

bool hasFrameNumber(const std::string& pattern) { return findFrameNumber(pattern).has_value(); }

std::string numberedName(const std::string& pattern, int frame) {
  const std::optional<FrameNumber> number = findFrameNumber(pattern);
  if (!number) return pattern;
  char digits[128];
  std::snprintf(digits, sizeof digits, "%0*d", number->digits, frame);
  return pattern.substr(0, number->begin) + digits + pattern.substr(number->end);
}

fs::path findResourceRoot(const char* fromEnvironment, const fs::path& executableFolder,
                          const fs::path& sourceRoot) {
  if (fromEnvironment != nullptr && *fromEnvironment != '\0') {
    if (holdsResources(fromEnvironment)) return fromEnvironment;
    throw InputOutputError(
        std::string("CLOTHSIM_ROOT is ") + fromEnvironment +
        ", but there is no assets/scenes in it; let it name the folder that holds assets/ and shaders/");
  }
  for (fs::path folder = executableFolder; !folder.empty(); folder = folder.parent_path()) {
    if (holdsResources(folder)) return folder;
    if (holdsResources(folder / "share" / "clothsim")) return folder / "share" / "clothsim";
    if (folder == folder.parent_path()) break;
  }
  if (holdsResources(sourceRoot)) return sourceRoot;
  throw InputOutputError("found no folder with assets/scenes beside the program (" +
                         executableFolder.string() + "), above it, or in " + sourceRoot.string() +
                         "; set CLOTHSIM_ROOT to the folder that holds assets/ and shaders/");
}

static fs::path& searchedFolder() {
  static fs::path folder;
  return folder;
}

void beginResourceSearchAt(const fs::path& folder) { searchedFolder() = folder; }

fs::path userConfigFolder() {
  // The XDG specification demands that relative paths are ignored.
  const char* xdg = std::getenv("XDG_CONFIG_HOME");
  if (xdg != nullptr && fs::path(xdg).is_absolute()) return fs::path(xdg) / "clothsim";
  const char* home = std::getenv("HOME");
  if (home != nullptr && fs::path(home).is_absolute()) return fs::path(home) / ".config" / "clothsim";
  return {};
}

std::string saveInConfigFolder(const fs::path& path, std::string_view bytes) {
  if (path.empty()) return "neither XDG_CONFIG_HOME nor HOME names a folder for settings";
  std::error_code ignored;  // the writer complains
  fs::create_directories(path.parent_path(), ignored);
  try {
    writeFileAtomically(path, bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const fs::path& resourceRoot() {
  static const fs::path root = [] {
    std::error_code ignored;
    const fs::path executable = fs::read_symlink("/proc/self/exe", ignored);
    return findResourceRoot(std::getenv("CLOTHSIM_ROOT"),
                            searchedFolder().empty() ? executable.parent_path() : searchedFolder(),
                            CLOTHSIM_SOURCE_ROOT);
  }();
  return root;
}

}  // namespace clothsim
