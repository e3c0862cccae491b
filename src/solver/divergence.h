// What the watchdog finds: numbers that are no longer finite, and energy and strain that run away. Every pass
// tests what it writes, on the device and without a read-back; the host looks when it is asked to.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "shared/step_params.h"
#include "solver/pass.h"

namespace clothsim {

enum class DivergenceReason : std::uint32_t {
  nonFinite = REASON_NON_FINITE,         // an infinity or a NaN, or a speed beyond 1.8e19 m/s
  runawaySpeed = REASON_RUNAWAY_SPEED,   // beyond solver.max_speed
  runawayStrain = REASON_RUNAWAY_STRAIN  // a spring beyond solver.max_strain
};

// The first divergence of a simulation: the earliest step, in it the earliest pass, in that the lowest
// particle.
struct Divergence {
  DivergenceReason reason = DivergenceReason::nonFinite;
  Pass pass = Pass::checkStart;
  std::uint64_t step = 0;      // counted from 1: stepIndex() at the end of that step
  std::uint32_t particle = 0;  // of a spring: the end with the larger index, its owner (cloth/cloth.h)
  friend bool operator==(const Divergence&, const Divergence&) = default;
};

// What the passes of one step have noted, by PASS_... of shared/step_params.h: 4 * particle + reason, the
// lowest that came up, or NO_DIVERGENCE. A minimum does not depend on the order in which particles are
// visited, nor grids stepped, nor on whether passes are fused.
using WatchRow = std::array<std::uint32_t, PASSES>;
[[nodiscard]] WatchRow soundWatchRow();
// `step` as in Divergence.
[[nodiscard]] std::optional<Divergence> firstDivergence(const WatchRow& row, std::uint64_t step);

// For a person, as a sentence without its full stop: "in step 7 (frame 1), pass integrate, particle 12 (cloth
// 0, column 2, row 1) ...".
// Where `simulation_steps` has changed on the way, `frame` is to be given.
[[nodiscard]] std::string divergenceText(const Divergence& divergence, const Cloth& cloth, const Scene& scene,
                                         std::optional<int> frame = std::nullopt);
// What may help against it: in sentences, and as key=value for --set.
struct Remedy {
  std::string text;
  std::vector<std::string> settings;  // empty when no setting of the scene helps
};
[[nodiscard]] Remedy remedyFor(const Divergence& divergence, const Scene& scene);

}  // namespace clothsim
