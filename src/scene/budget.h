// What a scene may take of a machine, found out before it is taken: a short file can ask for much.
#pragma once

#include <cstddef>

namespace clothsim {

inline constexpr int smallestSide = 2, largestSide = 16384;  // of a grid [points]
inline constexpr double mostParticles = 67'108'864;          // 2^26, of all cloths together
inline constexpr int mostSteps = 1'000'000;                  // a frame

// Of a particle with all that belongs to it, in a run on the CPU at 1024 x 1024 (the largest of integrators
// and self-collisions) [bytes].
inline constexpr double BYTES_A_PARTICLE = 600;
// Samples of the distance grids of all mesh colliders together: 256 MiB, and half a minute on two cores.
inline constexpr std::size_t MOST_DISTANCE_SAMPLES = std::size_t{1} << 26;

// The machine's memory, or what the group of processes may have of it [bytes].
[[nodiscard]] double machineMemory();
// @throws SceneError when so many particles need more than `memory`
void checkMemory(double particles, double memory = machineMemory());

}  // namespace clothsim
