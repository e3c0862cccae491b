// What the open dialog shows of a folder: its folders, scenes and meshes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace clothsim {

enum class FileKind { folder, scene, mesh };

struct FolderEntry {
  std::string name;
  FileKind kind = FileKind::folder;
  std::uintmax_t bytes = 0;
  std::string changed;  // "2026-11-26 04:50", local time; empty where it cannot be told
};

struct FolderList {
  std::vector<FolderEntry> entries;  // folders first, then by name, regardless of case
  std::string fault;                 // why it could not be read; "" when it was
};

// .json is a scene and .obj a mesh, regardless of case; anything else is a folder here, which stands for "no
// file of ours".
[[nodiscard]] FileKind kindOfFile(const std::filesystem::path& path);

// Hidden files, those of other kinds, and recordings are left out. Never throws.
[[nodiscard]] FolderList listFolder(const std::filesystem::path& folder);

// Whether the words occur in the name, regardless of case.
[[nodiscard]] bool contains(std::string_view name, std::string_view words);

}  // namespace clothsim
