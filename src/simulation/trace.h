// Measures over time: a row a frame, for `run --trace` and the Python package.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "simulation/run_summary.h"
#include "simulation/simulation.h"

namespace clothsim {

class Trace {
 public:
  // The columns; what `run --json` reports, too, has the same name there. Energies [J] are of free particles:
  // kinetic with the velocities of the frame's own time, gravity above the start, springs 1/2 k (l - L)^2
  // (bending of materials and meshes is not in it). Momentum [kg m/s] is the sum of m v. Strains are l/L - 1,
  // penetration [m] the deepest of this frame, seam_gap [m] Measures::seamGap. Counts of implicit steps are
  // those of this frame alone.
  static constexpr std::array columns{
      "frame",         "time",          "kinetic_energy", "gravity_energy",    "spring_energy",
      "total_energy",  "momentum_x",    "momentum_y",     "momentum_z",        "max_strain",
      "min_y",         "centroid_x",    "centroid_y",     "centroid_z",        "max_penetration",
      "seam_gap",      "self_contacts", "implicit_steps", "unconverged_steps", "newton_steps",
      "cg_iterations", "last_update"};
  using Row = std::array<double, columns.size()>;

  // Adds the frame that was last added to the summary.
  void add(const RunSummary& summary, Simulation& simulation);
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  // A line of names, then one a row; numbers as short as they can be read back exactly.
  [[nodiscard]] std::string csv() const;
  // An array of binary64 for each column (export/npz.h).
  [[nodiscard]] std::string npz() const;

 private:
  std::vector<Row> rows_;
  ConvergenceCounts before_;
};

}  // namespace clothsim
