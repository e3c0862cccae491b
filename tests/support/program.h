// The program as a user starts it, without a screen.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "support/command.h"

namespace clothsim::test {

// What it says on both streams; `environment` as VAR=value words before it.
inline CommandResult clothsim(const std::string& arguments, const std::string& environment = "") {
  return runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " + environment + " " CLOTHSIM_PROGRAM " " +
                    arguments + " 2>&1");
}

// The JSON object on stdout of a command that must end so.
inline nlohmann::json jsonOf(const std::string& arguments, const std::string& environment = "",
                             int exitCode = 0) {
  const CommandResult result =
      runCommand("env " + environment + " " CLOTHSIM_PROGRAM " " + arguments + " 2>/dev/null");
  EXPECT_EQ(result.exitCode, exitCode) << arguments;
  return nlohmann::json::parse(result.output, nullptr, false);
}

}  // namespace clothsim::test
