// Numbers about self-contact that a person can judge, and whether the condition held under which no two
// triangles can have crossed (solver/self_collision.h). Computed on the host from a read-back.
#pragma once

#include <cstdint>
#include <optional>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "solver/state.h"

namespace clothsim {

struct ContactMeasures {
  std::uint64_t contacts = 0;              // pairs of strangers within 1.05 contact distances
  std::uint64_t overlaps = 0;              // nearer than D: their triangles may cross
  std::optional<double> smallestDistance;  // of strangers in reach of each other [m]
  double neededDistance = 0;               // D for the stretch that there is [m]
  double relativeMotion = 0;               // delta: the largest of strangers in reach, in a step [m]
};

// `stretch` is the largest l / L - 1 of the state. Nothing is measured in a scene without self-collision.
[[nodiscard]] ContactMeasures measureContacts(const Cloth& cloth, const Scene& scene, const State& state,
                                              double stretch);

}  // namespace clothsim
