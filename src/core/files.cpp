// Files read and written whole or not at all.
#include "core/files.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.h"

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
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status)) throw InputOutputError(path.string() + ": is a folder, not a file");
  // /dev/null and its kind must not be replaced by a file.
  const bool replaces = !fs::exists(status) || fs::is_regular_file(status);
  // Through a symbolic link to the file it names, as an ordinary write would.
  target_ = fs::is_symlink(fs::symlink_status(path, code)) ? fs::weakly_canonical(path, code) : path;
  if (replaces) temporary_ = temporaryNameBeside(target_);
  errno = 0;
  file_ = std::fopen((replaces ? temporary_ : path).c_str(), "wb");
  if (file_ == nullptr) throw failure(path_, "cannot be written", errno);
  if (fs::exists(status) && replaces) fs::permissions(temporary_, status.permissions(), code);
}

GrowingFile::~GrowingFile() {
  if (file_ != nullptr) std::fclose(file_);
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void GrowingFile::append(std::string_view bytes) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
    throw failure(path_, "cannot be written", errno);
}

void GrowingFile::overwrite(std::uint64_t offset, std::string_view bytes) {
  errno = 0;
  if (std::fseek(file_, static_cast<long>(offset), SEEK_SET) != 0)
    throw failure(path_, "cannot be written", errno);
  append(bytes);
  if (std::fseek(file_, 0, SEEK_END) != 0) throw failure(path_, "cannot be written", errno);
}

void GrowingFile::close() {
  errno = 0;
  // A full disk may show only when the buffer is flushed by closing.
  const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
  if (!closed) throw failure(path_, "cannot be written", errno);
  if (temporary_.empty()) return;
  std::error_code code;
  fs::rename(temporary_, target_, code);
  if (code) throw failure(path_, "cannot be written", code.value());
  temporary_.clear();
}

void writeFileAtomically(const fs::path& path, std::string_view bytes) {
  GrowingFile file(path);
  file.append(bytes);
  file.close();
}

void checkWritable(const fs::path& path) {
  if (fs::is_directory(path)) throw failure(path, "cannot be written", EISDIR);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (access(folder.c_str(), W_OK | X_OK) != 0) throw failure(path, "cannot be written", errno);
}

fs::path temporaryNameBeside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  const std::string name = ".clothsim-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
  return path.parent_path() / (name + path.extension().string());
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

const fs::path& resourceRoot() {
  static const fs::path root = [] {
    std::error_code ignored;
    const fs::path executable = fs::read_symlink("/proc/self/exe", ignored);
    return findResourceRoot(std::getenv("CLOTHSIM_ROOT"), executable.parent_path(), CLOTHSIM_SOURCE_ROOT);
  }();
  return root;
}

}  // namespace clothsim
