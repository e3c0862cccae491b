// What a run is summed up in, gathered at the end of every frame: the measures of `run --json` and `sweep`.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "measure/measure.h"
#include "measure/run_watch.h"
#include "simulation/simulation.h"

namespace clothsim {

struct RunSummary {
  double seconds = 0;  // wall time of the step loop, which whoever steps adds to
  double peakStrain = -1, maxPenetration = 0;
  int frame = -1;     // the last one that was looked at
  State state;        // at its end
  Measures measures;  // of that state
  RunWatch watch;

  // Looks at the start, which is frame 0, and at the end of every frame.
  void add(Simulation& simulation);
  // state_hash, max_strain, peak_strain, ... of `run --json`.
  void write(nlohmann::ordered_json& json, Simulation& simulation) const;
};

}  // namespace clothsim
