// Bytes that are collected on the disk until a file can be made of them: in a file without a name, beside the
// one to be made, gone in any case.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/temporary_file.h"

namespace clothsim {

class Spool {
 public:
  // For the file at `path`, which messages name. @throws InputOutputError, from every function
  explicit Spool(const std::filesystem::path& path);

  void append(std::string_view bytes);
  [[nodiscard]] std::string read(std::uint64_t offset, std::size_t count);
  // Everything has been written to it.
  [[nodiscard]] int descriptor();

 private:
  void flush();

  std::filesystem::path path_;
  TemporaryFile file_;
  std::string pending_;
  std::uint64_t size_ = 0;  // without what is pending
};

}  // namespace clothsim
