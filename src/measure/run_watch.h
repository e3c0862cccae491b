// What may make the numbers or pictures of a run useless although it ended: contact that was lost, springs
// stretched beyond what cloth bears, paths that jump. Gathered at frame ends; said in one line each,
// everywhere.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "measure/contact_report.h"
#include "measure/measure.h"
#include "scene/scene.h"
#include "solver/state.h"

namespace clothsim {

struct Warning {
  std::string kind;          // "start", "path", "contact" or "strain"
  std::optional<int> frame;  // in which it was seen first
  std::string brief;         // for the viewer's overlay
  std::string text;          // what it is, and what to set
};

// The strain (l/L - 1) from which on a scene's results are doubtful: half its length for a scene with a
// material, which no fabric bears; its whole length for springs alone, which students also make soft.
[[nodiscard]] double doubtfulStrain(const Scene& scene);

// Paths that begin away from their pins, and loops that jump where they begin again. `state` is that of the
// start.
[[nodiscard]] std::vector<Warning> pathWarnings(const Cloth& cloth, const Scene& scene, const State& state);

class RunWatch {
 public:
  // Looks at the state that a run begins with, before the first step.
  void start(const Cloth& cloth, const Scene& scene, const State& state);
  // Looks at the end of a frame; frame 0 is the start. `strain` as Measures::maxStrain, `counts` up to now.
  void add(int frame, const Cloth& cloth, const Scene& scene, const State& state, double strain,
           const ContactCounts& counts);

  [[nodiscard]] const ContactReport& contacts() const { return contacts_; }
  [[nodiscard]] const ColliderOverlaps& startInColliders() const { return startInColliders_; }
  // In the order start, path, contact, strain; of each kind but paths at most one.
  [[nodiscard]] std::vector<Warning> warnings(const Scene& scene) const;

 private:
  ContactReport contacts_;
  ColliderOverlaps startInColliders_;
  std::vector<Warning> paths_;
  std::optional<int> doubtfulFrame_;  // the first with a doubtful strain
  double peakStrain_ = 0;
};

// One line each on stderr: "clothsim: warning: frame 12: ...". `which` tells which run of several it is.
void print(const std::vector<Warning>& warnings, const std::string& which = "");
[[nodiscard]] nlohmann::ordered_json toJson(const std::vector<Warning>& warnings);
// Under `strict` @throws SimulationError when there is any warning
void checkStrict(bool strict, const std::vector<Warning>& warnings);

}  // namespace clothsim
