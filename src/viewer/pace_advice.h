// What keeps a scene from its pace, and what would help. A remedy keeps what the scene is about: a grid loses
// two thirds of its particles at most and no side of 33 points or less.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/quality.h"
#include "scene/scene.h"

namespace clothsim {

// Over the last half second.
struct PaceFigures {
  double pace = 1;      // simulated seconds per second, over those that are wanted
  double stepping = 0;  // parts of the time, 0 to 1; on two threads both may be large
  double drawing = 0;
  double tempo = 1;  // simulated seconds per second that are wanted
};

// Which a button applies.
struct PaceRemedy {
  std::string name;  // "56 × 56 particles"
  std::optional<Quality> quality{};
  std::optional<Scene> scene{};
  std::optional<std::string> backend{};
  std::optional<double> tempo{};
  // Simulated seconds per second with it, measured on this machine; none: not measured.
  std::optional<double> pace{};
};

struct PaceAdvice {
  std::string cause;                   // "Stepping takes 90 % of the time"
  std::vector<PaceRemedy> remedies{};  // the best first
};

// Whether the scene falls behind.
[[nodiscard]] bool isSlow(const PaceFigures& figures);
// "Stepping takes 90 % of the time", or drawing.
[[nodiscard]] std::string causeOf(const PaceFigures& figures);

// What may help, to be tried. `software`: OpenGL is a software renderer.
[[nodiscard]] std::vector<PaceRemedy> remediesFor(const PaceFigures& figures, const Scene& scene,
                                                  Quality quality, bool software, const std::string& backend);
// Of remedies that have been tried, those that help, at most three: first those that hold the pace, in their
// order, then the faster ones. Slow motion, which needs no trial, holds it.
[[nodiscard]] std::vector<PaceRemedy> bestOf(std::vector<PaceRemedy> tried, const PaceFigures& figures);

// The next of 1, 0.5, 0.25, 0.1, and back to 1.
[[nodiscard]] double nextTempo(double tempo);

}  // namespace clothsim
