#include "viewer/pace_trials.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/thread_priority.h"
#include "simulation/simulation.h"

namespace clothsim {
namespace {

constexpr double trialSeconds = 0.3;

// Between four particles of a grid.
struct GridSpot {
  std::size_t corner = 0, nextColumn = 0, nextRow = 0;
  float across = 0, along = 0;  // parts of the way to them

  [[nodiscard]] Particle4 of(const std::vector<Particle4>& all) const {
    const auto mix = [&](auto member) {
      const float low = (1 - across) * all[corner].*member + across * all[corner + nextColumn].*member;
      const float high =
          (1 - across) * all[corner + nextRow].*member + across * all[corner + nextRow + nextColumn].*member;
      return (1 - along) * low + along * high;
    };
    return {mix(&Particle4::x), mix(&Particle4::y), mix(&Particle4::z), 0};
  }
};

GridSpot spotOf(int column, int row, const Piece& from, const Piece& to) {
  const auto place = [](int i, int points, int of) {
    const double at = of > 1 ? double(i) / (of - 1) * (points - 1) : 0;
    const int first = std::clamp(static_cast<int>(at), 0, std::max(0, points - 2));
    return std::pair(first, static_cast<float>(at - first));
  };
  const auto [x, across] = place(column, from.columns, to.columns);
  const auto [y, along] = place(row, from.rows, to.rows);
  const auto width = static_cast<std::size_t>(from.columns);
  return {static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x), from.columns > 1 ? 1u : 0u,
          from.rows > 1 ? width : 0, across, along};
}

}  // namespace

State resampled(const State& state, const Cloth& from, const Cloth& to) {
  const auto& before = from.pieces();
  const auto& after = to.pieces();
  const bool isGrid = before.size() == 1 && after.size() == 1 && !before[0].isMesh && !after[0].isMesh;
  if (!isGrid || (before[0].columns == after[0].columns && before[0].rows == after[0].rows)) return state;
  State result;
  result.clock = state.clock;
  result.integrator = state.integrator;
  for (int row = 0; row < after[0].rows; ++row)
    for (int column = 0; column < after[0].columns; ++column) {
      const GridSpot spot = spotOf(column, row, before[0], after[0]);
      result.positions.push_back(spot.of(state.positions));
      result.velocities.push_back(spot.of(state.velocities));
      result.positions.back().w = static_cast<float>(to.inverseMasses()[result.positions.size() - 1]);
      if (result.positions.back().w == 0) result.velocities.back() = {};
    }
  return result;
}

double measuredPace(const Shared<Scene>& scene, const Cloth& from, const State& state) {
  using Clock = std::chrono::steady_clock;
  Simulation trial(scene);
  trial.setState(resampled(state, from, trial.cloth()));
  trial.step(1);  // makes what later steps keep
  int steps = 0;
  double seconds = 0;
  for (const Clock::time_point start = Clock::now(); seconds < trialSeconds;
       seconds = std::chrono::duration<double>(Clock::now() - start).count()) {
    trial.step(1);
    ++steps;
  }
  if (trial.solver().divergence()) return 0;
  return steps * stepLength(scene->solver) / seconds;
}

struct PaceTrials::Work {
  std::vector<PaceRemedy> remedies;
  Shared<Scene> scene;
  Shared<Cloth> cloth;
  State state;
  double wanted;
  std::atomic<bool> isDone{false}, isAbandoned{false};

  void tryAll() {
    giveWay();
    std::vector<PaceRemedy> tried;
    int enough = 2;  // of those that reach the pace
    for (PaceRemedy& remedy : remedies) {
      if (remedy.tempo || remedy.quality || remedy.backend == "gpu") {
        tried.push_back(std::move(remedy));
        continue;
      }
      if (isAbandoned || enough == 0) continue;
      try {
        remedy.pace = measuredPace(remedy.scene ? Shared<Scene>(*remedy.scene) : scene, *cloth, state);
        if (*remedy.pace >= wanted) --enough;
        tried.push_back(std::move(remedy));
      } catch (const std::exception&) {  // it cannot be made
      }
    }
    remedies = std::move(tried);
    isDone = true;
  }
};

void PaceTrials::start(std::vector<PaceRemedy> remedies, const Shared<Scene>& scene,
                       const Shared<Cloth>& cloth, State state, double wanted) {
  work_ = std::shared_ptr<Work>(new Work{std::move(remedies), scene, cloth, std::move(state), wanted});
  std::thread([work = work_] { work->tryAll(); }).detach();
}

bool PaceTrials::isDone() const { return work_ && work_->isDone; }

std::vector<PaceRemedy> PaceTrials::take() { return std::exchange(work_, nullptr)->remedies; }

void PaceTrials::abandon() {
  if (work_) work_->isAbandoned = true;
  work_.reset();
}

}  // namespace clothsim
