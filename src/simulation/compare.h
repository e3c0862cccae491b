// Simulates a scene on both backends and compares their states bit by bit. Used by `clothsim compare`, by
// `doctor` and by tests.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "simulation/simulation.h"
#include "solver/divergence.h"
#include "solver/solver.h"
#include "solver/state.h"

namespace clothsim {

struct Comparison {
  int frames = 0;  // compared; fewer than asked for when the backends differ or have divergence
  std::uint64_t steps = 0;
  std::uint64_t floats = 0;           // in a state: 6 a particle
  std::uint64_t differingFloats = 0;  // in the first frame that differs
  double maxAbsDifference = 0;
  std::optional<std::uint64_t> firstDifferingStep;  // the frame is repeated step by step to find it
  bool finite = true;
  // The divergence of each backend in the frame after those; they differ only when a driver breaks the
  // numeric contract.
  std::optional<Divergence> cpuDivergence, gpuDivergence;
  ContactCounts contacts;  // of the CPU backend
  std::string device, cpuHash, gpuHash;
};

struct StateDifference {
  std::uint64_t floats = 0, differing = 0;
  double maxAbs = 0;
  bool finite = true;  // whether both states are
};
[[nodiscard]] StateDifference difference(const State& a, const State& b);

// `makeSolver` knows "cpu" and "gpu". `atFrame` is called for frame 0 and after every frame with the state of
// the CPU backend. Stops after the first frame that differs or has divergence.
[[nodiscard]] Comparison compareBackends(const Shared<Scene>& scene, int frames, SolverFactory makeSolver,
                                         const std::function<void(int, const State&)>& atFrame = {});

}  // namespace clothsim
