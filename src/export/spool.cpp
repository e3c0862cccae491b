#include "export/spool.h"

#include <unistd.h>

#include <cerrno>

#include "core/interrupt.h"

namespace clothsim {
namespace {

// A device has no place for files beside it.
Destination placeBeside(const std::filesystem::path& path) {
  const Destination destination = destinationOf(path);
  if (destination.isReplaced) return Destination{.file = destination.file};
  return Destination{.file = std::filesystem::temp_directory_path() / "clothsim"};
}

}  // namespace

Spool::Spool(const std::filesystem::path& path) : path_(path), file_(path, placeBeside(path)) {
  file_.removeName();
}

void Spool::flush() {
  std::string_view rest = pending_;
  while (!rest.empty()) {
    const ssize_t written = ::pwrite(file_.descriptor(), rest.data(), rest.size(), static_cast<off_t>(size_));
    if (written > 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
      size_ += static_cast<std::uint64_t>(written);
    } else if (written < 0 && errno == EINTR) {
      stopIfInterrupted();
    } else {
      throw cannotBeWritten(path_, written < 0 ? errno : EIO);
    }
  }
  pending_.clear();
}

void Spool::append(std::string_view bytes) {
  constexpr std::size_t worthWriting = 1 << 16;
  pending_ += bytes;
  if (pending_.size() >= worthWriting) flush();
}

std::string Spool::read(std::uint64_t offset, std::size_t count) {
  flush();
  std::string bytes(count, '\0');
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got =
        ::pread(file_.descriptor(), bytes.data() + done, count - done, static_cast<off_t>(offset + done));
    if (got > 0)
      done += static_cast<std::size_t>(got);
    else if (got < 0 && errno == EINTR)
      stopIfInterrupted();
    else
      throw cannotBeWritten(path_, got < 0 ? errno : EIO);
  }
  return bytes;
}

int Spool::descriptor() {
  flush();
  return file_.descriptor();
}

}  // namespace clothsim
