// What suits this machine, by the demo: a backend, a size and a quality of pictures. Measured once, in about
// three seconds, and kept in the user's folder of configurations, until the device or the program is another.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render/quality.h"

namespace clothsim {

struct Proposal {
  std::string backend;           // "gpu" or "cpu"
  int size = 0;                  // N of N x N
  Quality quality{};             // of the viewer's pictures
  double simulationSeconds = 0;  // wall time to simulate a 30th of a second of the demo's start, at that size
  double drawSeconds = 0;        // wall time of a picture of 1280 x 720 pixels
  friend bool operator==(const Proposal&, const Proposal&) = default;
};

// Both backends are measured where OpenGL is hardware, or when `both` says so: on a software renderer the CPU
// is faster, and compiling the GPU's shaders would take longer than everything else. Needs a current context.
[[nodiscard]] Proposal measureProposal(bool both);

// What a proposal is good for: this program on the device of the current context.
[[nodiscard]] std::string machineName();
// $XDG_CONFIG_HOME/clothsim/machine.json or ~/.config/clothsim/machine.json; empty where neither is set.
[[nodiscard]] std::filesystem::path proposalPath();
// None where the file is of another machine, or cannot be read as one.
[[nodiscard]] std::optional<Proposal> keptProposal(const std::filesystem::path& path,
                                                   const std::string& machine);
// Returns why it could not be written, "" when it was.
[[nodiscard]] std::string keepProposal(const Proposal& proposal, const std::filesystem::path& path,
                                       const std::string& machine);
// "64x64"
[[nodiscard]] std::string resolutionOf(const Proposal& proposal);

// The one that is kept; else it is measured, announced on stderr, and kept. In a context of its own.
// @throws OpenGlError where there is none
[[nodiscard]] Proposal proposalHere();

}  // namespace clothsim
