// What keeps a scene from its pace, and what would help.
#pragma once

#include <optional>
#include <string>

#include "render/quality.h"
#include "scene/scene.h"

namespace clothsim {

// Over the last half second.
struct PaceFigures {
  double pace = 1;      // simulated seconds per second, over those that are wanted
  double stepping = 0;  // parts of the time, 0 to 1; on two threads both may be large
  double drawing = 0;
};

// One remedy, which a button applies.
struct PaceAdvice {
  std::string cause, button;
  std::optional<Quality> quality;
  std::optional<Scene> scene;
  std::optional<std::string> backend;
};

// None where the pace is held, or where nothing is known to help.
[[nodiscard]] std::optional<PaceAdvice> adviceFor(const PaceFigures& figures, const Scene& scene,
                                                  Quality quality, bool software, const std::string& backend);

// The next of 1, 0.5, 0.25, 0.1, and back to 1.
[[nodiscard]] double nextTempo(double tempo);

}  // namespace clothsim
