// The errors meant for the user. Each kind maps to one exit code of the command line.
#pragma once

#include <stdexcept>
#include <string>

#include "core/printable.h"

namespace clothsim {

enum class ExitCode : int {
  done = 0,
  failed = 1,
  usage = 2,
  scene = 3,
  openGl = 4,
  inputOutput = 5,
  interrupted = 130
};

// A message for a person: the file and place, what was found, what was expected, and what to do. It may quote
// foreign files: what() has been through printable().
class Error : public std::runtime_error {
 public:
  Error(ExitCode exitCode, const std::string& message)
      : std::runtime_error(printable(message)), exitCode_(exitCode) {}
  [[nodiscard]] ExitCode exitCode() const { return exitCode_; }

 private:
  ExitCode exitCode_;
};

struct SimulationError : Error {
  explicit SimulationError(const std::string& message) : Error(ExitCode::failed, message) {}
};
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};
struct SceneError : Error {
  explicit SceneError(const std::string& message) : Error(ExitCode::scene, message) {}
};
struct OpenGlError : Error {
  explicit OpenGlError(const std::string& message) : Error(ExitCode::openGl, message) {}
};
struct InputOutputError : Error {
  explicit InputOutputError(const std::string& message) : Error(ExitCode::inputOutput, message) {}
};
struct Interrupted : Error {
  explicit Interrupted(const std::string& message) : Error(ExitCode::interrupted, message) {}
};

}  // namespace clothsim
