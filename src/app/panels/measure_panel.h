// Measure: numbers and curves about the cloth. They need the state on the host, so it is read back only while
// the panel is open, a few times a second and for no more than a tenth of the time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/session.h"
#include "solver/energies.h"
#include "solver/gpu/pass_runner.h"

namespace clothsim {

class MeasurePanel {
 public:
  // `look`: of the picture; where it shows strain as colours, there is a legend.
  void draw(Session& session, const RenderSettings& look);

  // While the panel is open: takes a sample when it is time for one. `particleUnderCursor` is asked then.
  template <class UnderCursor>
  void update(Session& session, double now, UnderCursor&& particleUnderCursor) {
    if (!open_ || now < nextSample_) return;
    sample(session, now, particleUnderCursor());
  }
  void setOpen(bool open) { open_ = open; }
  // So many particles times steps took so long.
  void stepped(double particleSteps, double seconds);
  // The simulation began anew: so do the curves.
  void forget();

 private:
  struct Sample {
    double time = 0;
    Energies energies;
  };

  void sample(Session& session, double now, std::optional<std::uint32_t> underCursor);
  void drawNumbers(Session& session);
  void drawPlots();
  void drawPasses(Session& session);
  void drawMemory(Session& session);

  bool open_ = false;
  double nextSample_ = 0;
  std::deque<Sample> samples_;
  std::vector<Spring> springs_;
  std::optional<std::uint64_t> springsOf_;  // the generation of the cloth they belong to
  std::optional<double> strainUnderCursor_;
  std::size_t contacts_ = 0;
  std::uint64_t guardedSteps_ = 0;
  double particleSteps_ = 0, seconds_ = 0;  // since the last sample
  double rate_ = 0;                         // particle steps a second
  std::vector<PassTime> passes_;
  int passSteps_ = 0;
  std::string passTrouble_;
};

}  // namespace clothsim
