// clothsim, as a user without a screen types it.
#pragma once

#include <string>

#include "support/command.h"

namespace clothsim::test {

// `environment`: VAR=value words before it. Its output has both streams.
inline CommandResult clothsim(const std::string& arguments, const std::string& environment = "") {
  return runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " + environment + " " CLOTHSIM_PROGRAM " " +
                    arguments + " 2>&1");
}

}  // namespace clothsim::test
