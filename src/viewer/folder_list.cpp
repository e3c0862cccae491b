#include "viewer/folder_list.h"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <fstream>

namespace clothsim {

namespace fs = std::filesystem;

namespace {

std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string changeTimeOf(const fs::path& path) {
  struct stat facts {};
  std::tm time{};
  char text[32];
  if (::stat(path.c_str(), &facts) != 0 || ::localtime_r(&facts.st_mtime, &time) == nullptr) return "";
  return std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &time) > 0 ? text : "";
}

// "schema" stands at the beginning of a recording.
bool isRecording(const fs::path& path) {
  std::ifstream file(path);
  std::string begin(128, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin.find("clothsim-recording/") != std::string::npos;
}

}  // namespace

FileKind kindOfFile(const fs::path& path) {
  const std::string ending = lowered(path.extension().string());
  return ending == ".json" ? FileKind::scene : ending == ".obj" ? FileKind::mesh : FileKind::folder;
}

FolderList listFolder(const fs::path& folder) {
  FolderList list;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;  // of a link that leads nowhere
    const bool isFolder = entry->is_directory(ignored);
    if (name.starts_with('.') || (!isFolder && kindOfFile(name) == FileKind::folder)) continue;
    const bool isFile = entry->is_regular_file(ignored);  // a pipe would keep who reads it waiting
    if (isFile && kindOfFile(name) == FileKind::scene && isRecording(entry->path())) continue;
    FolderEntry found{name, isFolder ? FileKind::folder : kindOfFile(name), 0, changeTimeOf(entry->path())};
    const std::uintmax_t bytes = isFolder ? 0 : entry->file_size(ignored);
    if (!ignored) found.bytes = bytes;
    list.entries.push_back(std::move(found));
  }
  if (error) list.fault = folder.string() + " cannot be read: " + error.message();
  std::ranges::sort(list.entries, [](const FolderEntry& a, const FolderEntry& b) {
    const bool first = a.kind == FileKind::folder, second = b.kind == FileKind::folder;
    return first != second ? first : lowered(a.name) < lowered(b.name);
  });
  return list;
}

bool contains(std::string_view name, std::string_view words) {
  return lowered(name).find(lowered(words)) != std::string::npos;
}

}  // namespace clothsim
