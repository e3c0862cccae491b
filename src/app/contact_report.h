// What a run tells of self-contact: the numbers of `run --json` and `compare --json`, gathered at frame ends.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "solver/cpu/measure_contacts.h"
#include "solver/solver.h"
#include "solver/state.h"

namespace clothsim {

class ContactReport {
 public:
  // Looks at a frame end; the first call sees the start. `stretch` as in Measures::maxStrain.
  void add(const Cloth& cloth, const Scene& scene, const State& state, double stretch);

  // self_contacts of the last frame; contact_sound, whether no two triangles of strangers can have crossed at
  // any frame end (null where that is not known: without self-collision, and once cloth is cut); and the
  // numbers behind that under `contact`.
  void write(nlohmann::ordered_json& json, const Cloth& cloth, const Scene& scene,
             const ContactCounts& counts) const;

  // What to tell who runs with "averaged" once its cloth has touched itself; else "".
  [[nodiscard]] std::string remark(const Scene& scene) const;

  [[nodiscard]] std::uint64_t overlapsAtStart() const { return overlapsAtStart_; }
  [[nodiscard]] std::uint64_t contacts() const { return last_.contacts; }

 private:
  ContactMeasures last_, worst_;
  double stretch_ = 0;
  bool sound_ = true, started_ = false, isCut_ = false;
  std::uint64_t overlapsAtStart_ = 0;
};

}  // namespace clothsim
