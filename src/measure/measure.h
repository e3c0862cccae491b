// Numbers about a state that a person can judge: how far springs are stretched, how fast the cloth moves, how
// deep it sits in a collider. Computed on the host in double from a read-back.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cloth/cloth.h"
#include "solver/state.h"

namespace clothsim {

struct Measures {
  double maxStrain = 0;      // largest l/L - 1 over enabled springs that are not cut, 0 without any
  double minY = 0;           // [m]
  double kineticEnergy = 0;  // [J], of free particles, from the velocities as given
  double maxPenetration =
      0;           // [m], >= 0: into colliders, and across CS184's planes from the side a particle started on
  Vec3d centroid;  // of all particles [m]
  std::optional<std::uint32_t> firstNonFinite;  // lowest index of a particle with an infinity or NaN
};

// Free particles that lie inside a collider, deeper than contact itself leaves them: by more than 2 % of the
// smallest spacing. Planes have no inside.
struct ColliderOverlaps {
  std::uint32_t particles = 0;
  double depth = 0;  // of the deepest [m]
};
[[nodiscard]] ColliderOverlaps overlapsWithColliders(const Cloth& cloth, const Scene& scene,
                                                     const State& state);

[[nodiscard]] Measures measure(const Cloth& cloth, const Scene& scene, const State& state);

}  // namespace clothsim
