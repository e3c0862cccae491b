// Measures of a state: strain, kinetic energy, penetration of colliders and more. Computed on the host in
// double precision from a copy of the state.
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
  double kineticEnergy = 0;  // of free particles, with the velocities as given [J]
  // The deepest penetration of a collider [m], >= 0. CS184's planes are penetrated from the side on which a
  // particle started.
  double maxPenetration = 0;
  double seamGap = 0;                           // SeamGap::distance of all seams [m]
  Vec3d centroid;                               // mean of all particles [m]
  std::optional<std::uint32_t> firstNonFinite;  // lowest index of a particle with an infinity or NaN
};

// The number of free particles inside a collider. A depth up to 2 % of the smallest spacing is not counted,
// since contact itself leaves as much. CS184's planes have no inside; those with Coulomb's friction do.
struct ColliderOverlaps {
  std::uint32_t particles = 0;
  double depth = 0;  // of the deepest [m]
};
[[nodiscard]] ColliderOverlaps overlapsWithColliders(const Cloth& cloth, const Scene& scene,
                                                     const State& state);
// The number of particles that lie where others do, within 0.01 mm, to which no seam joins them: borders of
// panels that were neither welded nor sewn.
[[nodiscard]] std::uint64_t coincidentPoints(const Cloth& cloth, const State& state);

// Where the springs of seams are longest, beyond the length that their seam leaves them now.
struct SeamGap {
  double distance = 0;     // [m]; 0 without seams
  std::uint32_t seam = 0;  // its place in Scene::seams
  double stiffness = 0;    // of the spring [N/m]
};
// Of the seams that have been closed for as long as `settled` [s]; without it, of all.
[[nodiscard]] SeamGap seamGap(const Cloth& cloth, const Scene& scene, const State& state,
                              std::optional<double> settled = {});

[[nodiscard]] Measures measure(const Cloth& cloth, const Scene& scene, const State& state);

}  // namespace clothsim
