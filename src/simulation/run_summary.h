// Measures of a run that `run --json` and `sweep` report. They are collected at the end of every frame.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "measure/measure.h"
#include "measure/run_watch.h"
#include "simulation/simulation.h"

namespace clothsim {

struct RunSummary {
  double seconds = 0;  // wall time of all steps; the caller adds to it
  double peakStrain = -1, maxPenetration = 0;
  int frame = -1;                 // number of the last add()
  State state;                    // at the end of that frame
  Measures measures;              // of that state
  ConvergenceCounts convergence;  // up to it
  RunWatch watch;
  bool watchesEnergy = false;  // RunWatch::watchEnergy()

  // To be called at the start, which is frame 0, and at the end of every frame.
  void add(Simulation& simulation) { add(simulation, frame + 1); }
  // The same where frames are left out: `number` is that of this one, more than that of the last.
  void add(Simulation& simulation, int number);
  // Adds state_hash, max_strain, peak_strain and more to the object that `run --json` prints.
  void write(nlohmann::ordered_json& json, Simulation& simulation) const;
};

}  // namespace clothsim
