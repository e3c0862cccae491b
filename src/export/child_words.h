// What a program that we have started says, into a file in memory that is its standard error.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>

namespace clothsim {

// The end of it, without the last line break: programs say last what went wrong.
[[nodiscard]] inline std::string lastWords(int file) {
  std::array<char, 2000> end;
  const off_t size = ::lseek(file, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - static_cast<off_t>(end.size()));
  const ssize_t got = ::pread(file, end.data(), end.size(), from);
  std::string said(end.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  while (said.ends_with('\n')) said.pop_back();
  if (from > 0) said.erase(0, said.find('\n') + 1);  // what is left of a line
  return said;
}

}  // namespace clothsim
