// What a run tells of self-contact: the numbers of `run --json` and `compare --json`, gathered at frame ends.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "cloth/cloth.h"
#include "measure/measure_contacts.h"
#include "scene/scene.h"
#include "solver/solver.h"
#include "solver/state.h"

namespace clothsim {

// The condition of contact that did not hold, first of all in a run.
struct ContactFailure {
  enum class Condition { pairsTooNear, fastStep };
  Condition condition = Condition::pairsTooNear;
  int frame = 0;                            // at whose end it was seen; 0: the start
  std::uint64_t pairs = 0;                  // nearer than
  double distance = 0, neededDistance = 0;  // D; the nearest of them [m]
};

class ContactReport {
 public:
  // Looks at the end of a frame; frame 0 is the start. `stretch` as in Measures::maxStrain, `counts` up to
  // now.
  void add(int frame, const Cloth& cloth, const Scene& scene, const State& state, double stretch,
           const ContactCounts& counts);

  // self_contacts of the last frame; contact_sound, whether no two triangles of strangers can have crossed at
  // any frame end (null where that is not known: without self-collision, and once cloth is cut); and the
  // numbers behind that under `contact`, with the condition that failed first. `counts` of the whole run.
  void write(nlohmann::ordered_json& json, const Cloth& cloth, const Scene& scene,
             const ContactCounts& counts) const;

  // None where contact is sound, or nothing is known of it.
  [[nodiscard]] const std::optional<ContactFailure>& failure() const { return failure_; }

  [[nodiscard]] std::uint64_t overlapsAtStart() const { return overlapsAtStart_; }
  [[nodiscard]] std::uint64_t contacts() const { return last_.contacts; }

 private:
  ContactMeasures last_, worst_;
  double stretch_ = 0;
  std::optional<ContactFailure> failure_;
  int lastFrame_ = 0;
  bool isCut_ = false;
  std::uint64_t overlapsAtStart_ = 0;
};

}  // namespace clothsim
