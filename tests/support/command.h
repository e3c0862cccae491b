// Runs a command as a user would type it, and keeps what it said and how it ended.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace clothsim::test {

struct CommandResult {
  int exitCode = -1;   // -1 when it was ended by a signal or could not be started
  std::string output;  // stdout, and stderr where the command says 2>&1
};

inline CommandResult runCommand(const std::string& command) {
  CommandResult result;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> part;
  for (std::size_t size; (size = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    result.output.append(part.data(), size);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
  return result;
}

}  // namespace clothsim::test
