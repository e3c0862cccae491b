#include "core/temporary_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <utility>

namespace clothsim {

namespace fs = std::filesystem;

namespace {

constexpr int mostLinks = 40;  // as in the kernel

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

// Neither a process number nor the time would do: two machines that share a folder may have both in common,
// and whoever can write there could lay a link under the name.
std::string unforeseeableName(const fs::path& path) {
  std::uint64_t number = 0;
  if (::getentropy(&number, sizeof number) != 0) throw cannotBeWritten(path, errno);
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), ".clothsim-%016llx", static_cast<unsigned long long>(number));
  return name.data();
}

// Some file systems have nothing to synchronise.
bool isSynchronised(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOSYS || errno == ENOTSUP;
}

// The name, too, survives a power failure then. A folder that may not be read cannot be synchronised.
void synchroniseFolder(const fs::path& path, const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) {
    if (errno == EACCES) return;
    throw cannotBeWritten(path, errno);
  }
  const int reason = isSynchronised(descriptor) ? 0 : errno;
  ::close(descriptor);
  if (reason != 0) throw cannotBeWritten(path, reason);
}

}  // namespace

InputOutputError cannotBeWritten(const fs::path& path, int errorNumber) {
  return InputOutputError(path.string() + ": cannot be written: " + std::strerror(errorNumber));
}

Destination destinationOf(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status))
    throw InputOutputError(path.string() + ": cannot be written: is a folder, not a file");
  if (!fs::status_known(status)) throw cannotBeWritten(path, code.value());
  Destination destination{.file = path, .exists = fs::exists(status)};
  for (int i = 0; i < mostLinks; ++i) {
    const fs::file_status link = fs::symlink_status(destination.file, code);
    if (!fs::status_known(link)) throw cannotBeWritten(path, code.value());
    if (!fs::is_symlink(link)) break;
    const fs::path next = fs::read_symlink(destination.file, code);
    if (code) throw cannotBeWritten(path, code.value());
    destination.file = destination.file.parent_path() / next;
  }
  if (!destination.exists) return destination;
  if (::access(path.c_str(), W_OK) != 0) throw cannotBeWritten(path, errno);
  destination.isReplaced = fs::is_regular_file(status);
  destination.permissions = static_cast<mode_t>(status.permissions()) & 0777;
  return destination;
}

TemporaryFile::TemporaryFile(fs::path path, Destination destination)
    : path_(std::move(path)), destination_(std::move(destination)) {
  name_ = folderOf(destination_.file) / unforeseeableName(path_);
  descriptor_ =
      ::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, destination_.permissions);
  if (descriptor_ < 0) throw cannotBeWritten(path_, errno);
  // open() has taken away the permissions that the umask denies; those of a replaced file are restored.
  if (destination_.exists) (void)::fchmod(descriptor_, destination_.permissions);
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!name_.empty()) ::unlink(name_.c_str());
}

void TemporaryFile::removeName() {
  (void)::unlink(name_.c_str());
  name_.clear();
}

void TemporaryFile::publish() {
  if (!isSynchronised(descriptor_)) throw cannotBeWritten(path_, errno);
  // Some file systems report only here that the disk is full.
  if (::close(std::exchange(descriptor_, -1)) != 0) throw cannotBeWritten(path_, errno);
  if (::rename(name_.c_str(), destination_.file.c_str()) != 0) throw cannotBeWritten(path_, errno);
  name_.clear();
  synchroniseFolder(path_, folderOf(destination_.file));
}

}  // namespace clothsim
