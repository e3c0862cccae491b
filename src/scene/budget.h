// Limits on the memory that a scene takes, checked before it is taken: a short file can ask for much.
#pragma once

#include <cstddef>

namespace clothsim {

inline constexpr int smallestSide = 2, largestSide = 16384;  // of a grid [points]
inline constexpr double mostParticles = 67'108'864;          // 2^26, of all cloths together
inline constexpr int mostSteps = 1'000'000;                  // a frame

// Memory of a particle with all that belongs to it: the most among integrators and self-collisions, in a run
// on the CPU at 1024 x 1024 [bytes].
inline constexpr double BYTES_A_PARTICLE = 600;
// The most samples that the distance grids of all mesh colliders may have together: 256 MiB, and half a
// minute on two cores.
inline constexpr std::size_t MOST_DISTANCE_SAMPLES = std::size_t{1} << 26;

// The machine's memory, or the part of it that this group of processes may use [bytes].
[[nodiscard]] double machineMemory();
// @throws SceneError when so many particles need more than `memory`
void checkMemory(double particles, double memory = machineMemory());

}  // namespace clothsim
