// The comparison behind `clothsim compare`, `doctor` and the tests: the same scene on both backends, bit by
// bit.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "simulation/simulation.h"
#include "solver/solver.h"
#include "solver/state.h"
#include "solver/trouble.h"

namespace clothsim {

struct Comparison {
  int frames = 0;  // that were run; fewer than asked for when they differ
  std::uint64_t steps = 0;
  std::uint64_t floats = 0;           // of a state, 6 a particle
  std::uint64_t differingFloats = 0;  // in the first frame that differs
  double maxAbsDifference = 0;
  std::optional<std::uint64_t> firstDifferingStep;  // found by repeating that frame step by step
  bool finite = true;
  // Either backend's; they differ only when a driver breaks the agreement. The frame that it came up in
  // counts as run, and is not compared.
  std::optional<Trouble> cpuTrouble, gpuTrouble;
  ContactCounts contacts;  // the CPU's
  std::string device, cpuHash, gpuHash;
};

struct StateDifference {
  std::uint64_t floats = 0, differing = 0;
  double maxAbs = 0;
  bool finite = true;  // of both
};
[[nodiscard]] StateDifference difference(const State& a, const State& b);

// `makeSolver` knows "cpu" and "gpu". `atFrame` hears of frame 0 and every frame that is done, with the CPU's
// state. Stops after the first frame that differs or has trouble.
[[nodiscard]] Comparison compareBackends(const Shared<Scene>& scene, int frames, SolverFactory makeSolver,
                                         const std::function<void(int, const State&)>& atFrame = {});

}  // namespace clothsim
