// What a run is summed up in, gathered at the end of every frame: the measures of `run --json` and `sweep`.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "app/contact_report.h"
#include "app/simulation.h"
#include "solver/measure.h"

namespace clothsim {

struct Tally {
  double seconds = 0;  // wall time of the step loop, which whoever steps adds to
  double peakStrain = -1, maxPenetration = 0;
  std::uint32_t startInColliders = 0;  // particles
  State state;                         // at the end of the last frame
  Measures measures;                   // of that state
  ContactReport contacts;

  // Looks at the start, and at the end of every frame.
  void add(Simulation& simulation);
  // state_hash, max_strain, peak_strain, ... ; names as in DESIGN.md section 5.
  void write(nlohmann::ordered_json& json, Simulation& simulation) const;
};

}  // namespace clothsim
