// Warnings that the results of a run may be of no use although it completed: contact was lost, springs are
// stretched too far, paths jump, seams gape, implicit steps were not solved. They are collected at the end of
// every frame.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "measure/contact_report.h"
#include "measure/energy_watch.h"
#include "measure/measure.h"
#include "scene/scene.h"
#include "solver/state.h"

namespace clothsim {

struct Warning {
  std::string kind;  // "start", "step", "path", "contact", "seam", "strain", "energy", "convergence", "file"
  std::optional<int> frame;  // in which it was found first
  std::string brief;         // a few words, for the viewer's overlay
  std::string text;          // a sentence with advice
  friend bool operator==(const Warning&, const Warning&) = default;
};

// The strain l/L - 1 above which results are doubtful: 0.5 in a scene with a material, since no fabric
// stretches so far, and 1 in other scenes, since assignments use soft springs, too.
[[nodiscard]] double doubtfulStrain(const Scene& scene);

// Warns of paths that begin away from their pins and of loops that jump where they begin again. `state` is
// the state at the start.
[[nodiscard]] std::vector<Warning> pathWarnings(const Cloth& cloth, const Scene& scene, const State& state);

// That implicit steps ended before they were solved. `largestUpdate` is the largest last update that was
// seen.
[[nodiscard]] Warning convergenceWarning(const ConvergenceCounts& counts, double largestUpdate,
                                         const Scene& scene);

// That explicit steps are a tenth longer than stableStep(): with a strain limit such cloth may boil without
// blowing up.
[[nodiscard]] std::optional<Warning> longStepsWarning(const Scene& scene);

// That so far from the origin rounding stops slow motions in explicit steps, or is in strains of implicit
// ones.
[[nodiscard]] std::optional<Warning> farFromOriginWarning(const Scene& scene, const State& state);

// That seams gape though they have long been closed.
[[nodiscard]] std::optional<Warning> seamWarning(int frame, const Cloth& cloth, const Scene& scene,
                                                 const State& state);

// That layers meet nearer than the thickness of the cloth, which is too much for its cells.
[[nodiscard]] std::optional<Warning> thinLayersWarning(const Scene& scene, const Cloth& cloth);

class RunWatch {
 public:
  // To be called with the state before the first step.
  void start(const Cloth& cloth, const Scene& scene, const State& state);
  // To be called after it where the cloth starts as the scene says, and nobody drives it on the way.
  void watchEnergy(const Cloth& cloth, const Scene& scene, const State& state) {
    energy_.emplace(cloth, scene, state);
  }
  // The part of start() for which the state does not matter.
  void startWithoutState(const Cloth& cloth, const Scene& scene);
  // To be called at the end of every frame; frame 0 is the start. `strain` is Measures::maxStrain, `counts`
  // are those since the start.
  void add(int frame, const Cloth& cloth, const Scene& scene, const State& state, double strain,
           const ContactCounts& counts);
  // The same, with the kinetic energy [J].
  void addEnergy(int frame, const Cloth& cloth, const State& state, double kinetic) {
    if (energy_) energy_->add(frame, cloth, state, kinetic);
  }
  // The same, with the counts since the start.
  void addConvergence(int frame, const ConvergenceCounts& counts);

  [[nodiscard]] const ContactReport& contacts() const { return contacts_; }
  [[nodiscard]] const ColliderOverlaps& startInColliders() const { return startInColliders_; }
  // Those of the start come first; several may be of one kind. Of convergence only where more than a
  // hundredth of all implicit steps ended unsolved.
  [[nodiscard]] std::vector<Warning> warnings(const Scene& scene) const;

 private:
  void addStart(std::vector<Warning>& warnings, const Scene& scene) const;
  void addContacts(std::vector<Warning>& warnings, const Scene& scene) const;
  void addStrains(std::vector<Warning>& warnings, const Scene& scene) const;

  ContactReport contacts_;
  ColliderOverlaps startInColliders_;
  std::uint64_t coincidentPoints_ = 0;
  std::vector<Warning> paths_;
  std::optional<Warning> farFromOrigin_;
  std::optional<EnergyWatch> energy_;
  std::optional<int> doubtfulFrame_;  // the first with a doubtful strain
  double peakStrain_ = 0;
  double startStrain_ = 0;
  std::uint64_t crowdedSteps_ = 0;
  std::uint64_t passages_ = 0, unseenColliders_ = 0;
  std::optional<Warning> thinLayers_;
  std::optional<int> passedFrame_;
  std::optional<Warning> seams_;     // of the last frame
  double pinLag_ = 0;                // [m]
  std::optional<int> laggingFrame_;  // the first with pins far behind their paths
  std::optional<int> crowdedFrame_;  // the first with a step that had too many pairs to push
  ConvergenceCounts convergence_;
  double largestUpdate_ = 0;          // of the last steps of frames
  std::optional<int> unsolvedFrame_;  // the first with a step that ended unsolved
};

// Prints a line for each on stderr: "clothsim: warning: frame 12: ...". `which` names the run where there are
// several.
void print(const std::vector<Warning>& warnings, const std::string& which = "");
// The same for those that were not among the warnings of a run when it began, which were printed then.
void printLater(const std::vector<Warning>& warnings, const std::vector<Warning>& printed);
[[nodiscard]] nlohmann::ordered_json toJson(const std::vector<Warning>& warnings);
// @throws SimulationError when `strict` and there is any warning
void checkStrict(bool strict, const std::vector<Warning>& warnings);

}  // namespace clothsim
