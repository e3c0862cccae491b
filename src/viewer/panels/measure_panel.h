// The panel Measure: numbers and curves about the cloth. They need a copy of the state on the host. It is
// made a few times a second and takes at most a tenth of the time; for a large cloth it is made only while
// the panel is open. The warnings of the overlay come from the same samples, that of unsolved steps whatever
// the size of the cloth.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measure/energies.h"
#include "measure/recent_steps.h"
#include "measure/run_watch.h"
#include "session/session.h"
#include "solver/solver.h"
#include "viewer/open_scene.h"

namespace clothsim {

class MeasurePanel {
 public:
  // Returns whether the numbers of the curves are to be saved.
  [[nodiscard]] bool draw(const SessionFacts& facts);
  // Of the most strained spring there; known while the panel is open.
  [[nodiscard]] std::optional<double> strainUnderCursor() const {
    return underCursor_ ? std::optional(underCursor_->facts.strain) : std::nullopt;
  }
  // The curves as CSV, a line a sample; names and units are those of Trace. @throws InputOutputError
  void saveCurves(const std::filesystem::path& path) const;

  // Takes a sample when it is time for one. `particleUnderCursor` is called then. Times the passes of a step
  // if the button was pressed.
  template <class UnderCursor>
  void update(Session& session, double now, UnderCursor&& particleUnderCursor) {
    if (std::exchange(passesAsked_, false)) timePasses(session);
    const bool wanted = open_ || session.simulation().cloth().particleCount() <= ALWAYS_SAMPLED;
    if (now < nextSample_) return;
    sampleSteps(session, now);
    if (wanted) sample(session, now, open_ ? particleUnderCursor() : std::nullopt);
  }
  // The warnings from the samples since the last start; of unsolved steps only while there are any.
  [[nodiscard]] std::vector<Warning> warnings(const Scene& scene) const;
  void setOpen(bool open) { open_ = open; }
  // To be called when something else than a step has changed the simulation: what is shown is of before.
  void sampleSoon() { nextSample_ = 0; }
  // To be called with the number of particles times steps, and the time that they took.
  void stepped(double particleSteps, double seconds);
  // To be called when the simulation begins anew. Drops the samples and what has been counted.
  void forget(Session& session);
  // Before another frame is shown: what has been counted up to now stays so.
  void keepCounts(Session& session);
  // Before a step from a frame of the past: what came after it has not happened.
  void dropFuture(const Session& session);

 private:
  static constexpr std::uint32_t ALWAYS_SAMPLED = 65'536;  // particles

  struct Sample {
    double time = 0;
    Energies energies;
    RunWatch watch;  // what has been seen up to then,
    ContactCounts contacts;
  };
  struct UnderCursor {
    std::uint32_t particle = 0;
    ParticleFacts facts;
  };

  void sampleSteps(Session& session, double now);
  void sample(Session& session, double now, std::optional<std::uint32_t> underCursor);
  void drawNumbers(const Scene& scene);
  void drawUnderCursor();
  void drawContacts(SelfCollision mode);
  void drawConvergence();
  void drawPlots(SelfCollision mode);
  void drawPasses();
  void timePasses(Session& session);
  static void drawMemory(const SessionFacts& facts);

  bool open_ = false;
  double nextSample_ = 0;
  std::deque<Sample> samples_;
  std::vector<Spring> springs_;
  std::optional<std::uint64_t> springsOf_;  // the generation of their cloth
  std::optional<UnderCursor> underCursor_;
  RunWatch watch_;
  RecentSteps implicitSteps_;
  ContactCounts contactsBefore_, contacts_;  // up to where time went back last; up to now
  double seamGap_ = 0;                       // [m]
  double particleSteps_ = 0, seconds_ = 0;   // since the last sample
  double rate_ = 0;                          // particle steps a second
  std::vector<PassTime> passes_;
  int passSteps_ = 0;
  bool passesAsked_ = false;
  std::string passFault_;
};

}  // namespace clothsim
