// Measures of self-contact, and of the condition under which no two triangles can cross
// (solver/self_collision.h). Computed on the host from a copy of the state.
#pragma once

#include <cstdint>
#include <optional>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "solver/state.h"

namespace clothsim {

struct ContactMeasures {
  std::uint64_t contacts = 0;  // non-adjacent pairs of particles within 1.05 contact distances
  std::uint64_t overlaps = 0;  // non-adjacent pairs nearer than neededDistance: triangles may cross
  std::optional<double> smallestDistance;  // of the nearest non-adjacent pair, if any is near [m]
  double neededDistance = 0;               // D of solver/self_collision.h at this strain [m]
  double relativeMotion = 0;               // largest of near non-adjacent pairs in a step [m]
};

// `strain` is the largest l/L - 1 of the state. In a scene without self-collision all measures are 0.
[[nodiscard]] ContactMeasures measureContacts(const Cloth& cloth, const Scene& scene, const State& state,
                                              double strain);

}  // namespace clothsim
