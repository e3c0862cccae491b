// Measures of self-contact that `run --json` and `compare --json` report, collected at the end of every
// frame.
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

// The first violation in a run of the conditions under which no triangles can cross.
struct ContactFailure {
  enum class Condition { pairsTooNear, fastStep, startCrossings };
  Condition condition = Condition::pairsTooNear;
  int frame = 0;                            // at whose end it was found; 0: the start
  std::uint64_t pairs = 0;                  // of particles that are too near, or that cross
  double distance = 0, neededDistance = 0;  // of the nearest pair, and what it should be [m]
};

class ContactReport {
 public:
  // To be called at the end of every frame; frame 0 is the start. `strain` is Measures::maxStrain, `counts`
  // are those since the start.
  void add(int frame, const Cloth& cloth, const Scene& scene, const State& state, double strain,
           const ContactCounts& counts);

  // Adds to the object: self_contacts of the last frame; contact_sound, whether no two non-adjacent triangles
  // can have crossed at the end of any frame; and the measures behind that, with the first violation, under
  // `contact`. Without self-collision, and from a cut on, this is not known, and contact_sound is null unless
  // something was violated before.
  // Contact inside the step lets nothing cross in any step: there it is whether nothing crossed at the start.
  // `counts` are those of the whole run.
  void write(nlohmann::ordered_json& json, const Cloth& cloth, const Scene& scene,
             const ContactCounts& counts) const;

  // None where contact is sound or not known.
  [[nodiscard]] const std::optional<ContactFailure>& failure() const { return failure_; }

  [[nodiscard]] std::uint64_t overlapsAtStart() const { return overlapsAtStart_; }
  [[nodiscard]] std::uint64_t contacts() const { return last_.contacts; }

 private:
  ContactMeasures last_, worst_;
  double largestStrain_ = 0;
  std::optional<ContactFailure> failure_;
  int lastFrame_ = 0;
  bool isCut_ = false;
  std::uint64_t overlapsAtStart_ = 0;
};

}  // namespace clothsim
