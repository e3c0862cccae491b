#include "solver/cpu/row_passes.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <new>

#include "core/thread_team.h"
#include "solver/cpu/collide.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

// A thread begins with rows about its first one.
constexpr std::uint32_t LEAST_ROWS_AT_ONCE = 8;
// Less than that is not worth a thread; several cloths of less than that run side by side.
constexpr int LEAST_PARTICLES = 512, MOST_SIDE_BY_SIDE = 2048;
constexpr int LEAST_BAND = 4;  // rows; forces of two more are computed for each
// Of a cloth; plans are few: those of a step, and of what happens between steps.
constexpr std::size_t MOST_PLANS = 16;

// What a thread does of a sweep. Forces of the rows that it did last serve for those that follow them.
template <class Real>
struct Sweep {
  std::uint64_t number = 0;
  PieceRange last{};
  ForceRows<Real> forces;

  [[nodiscard]] bool goesOn(std::uint64_t sweep, const PieceRange& next) const {
    return number == sweep && last.piece == next.piece && last.end == next.begin;
  }
};

template <class Real>
bool beginRows(ForceRows<Real>& rows, const Piece& lattice) {
  return rows.begin(lattice.isMesh ? 0 : lattice.columns);
}

}  // namespace

template <class Real>
RowPasses<Real>::RowPasses(const Cloth& cloth) : cloth_(&cloth) {
  std::uint32_t particles = 0;
  bool hasGrid = false;
  for (const Piece& piece : cloth.pieces()) {
    limitColors_.push_back(makeLimitColors(piece));
    rowStarts_.push_back(rows_.size());
    rows_.add(static_cast<std::uint32_t>(rowStarts_.size() - 1), 0,
              static_cast<std::uint32_t>(rowsOf(piece)));
    particles += piece.particleCount();
    hasGrid |= !piece.isMesh;
  }
  rowStarts_.push_back(rows_.size());
  rowsAtOnce_ = std::max(ROW_PARTICLES_AT_ONCE * rows_.size() / std::max(particles, 1u),
                         hasGrid ? LEAST_ROWS_AT_ONCE : 1u);
  plans_.resize(cloth.pieces().size());
}

template <class Real>
auto RowPasses<Real>::rowPassOf(Pass pass) -> RowPass {
  using Arguments = ImplicitArguments<Real>;
  using Rows = ForceRows<Real>;
  switch (pass) {
    case Pass::checkStart:
      return [](const Arguments& piece, int row, Rows&) { cpu::checkStart(piece.step, row); };
    case Pass::kick:
      return [](const Arguments& piece, int row, Rows&) { cpu::kick(piece.step, row); };
    case Pass::forces:
      return [](const Arguments& piece, int row, Rows& rows) { cpu::gatherForces(piece.step, row, rows); };
    case Pass::integrate:
      return [](const Arguments& piece, int row, Rows&) { cpu::integrate(piece.step, row); };
    case Pass::collide:
      return [](const Arguments& piece, int row, Rows&) { cpu::collide(piece.step, row); };
    case Pass::watchLimit:
      return [](const Arguments& piece, int row, Rows&) { cpu::watchLimit(piece.step, row); };
    case Pass::begin:
      return [](const Arguments& piece, int row, Rows&) { cpu::begin(piece, row); };
    case Pass::findPlanes:
      return [](const Arguments& piece, int row, Rows&) {
        cpu::findPlanes(piece.step, piece.own.iterate.positions, piece.own.planes, row);
      };
    case Pass::predictPlanes:
      return [](const Arguments& piece, int row, Rows&) { cpu::predictPlanes(piece, row); };
    case Pass::elasticForces:
      return [](const Arguments& piece, int row, Rows& rows) { cpu::gatherElasticForces(piece, row, rows); };
    case Pass::linearize:
      return [](const Arguments& piece, int row, Rows&) { cpu::linearize(piece, row); };
    case Pass::updateDirection:
      return [](const Arguments& piece, int row, Rows&) { cpu::updateDirection(piece, row); };
    case Pass::multiply:
      return [](const Arguments& piece, int row, Rows& rows) { cpu::multiply(piece, row, rows); };
    case Pass::updateSolution:
      return [](const Arguments& piece, int row, Rows&) { cpu::updateSolution(piece, row); };
    case Pass::stopAtPlanes:
      return [](const Arguments& piece, int row, Rows&) { cpu::stopAtPlanes(piece, row); };
    case Pass::tryLengths:
      return [](const Arguments& piece, int row, Rows&) { cpu::tryLengths(piece, row); };
    case Pass::accept:
      return [](const Arguments& piece, int row, Rows&) { cpu::accept(piece, row); };
    case Pass::end:
      return [](const Arguments& piece, int row, Rows&) { cpu::end(piece, row); };
    case Pass::remember:
      return [](const Arguments& piece, int row, Rows&) { cpu::remember(piece, row); };
    default:
      assert(false && "this pass does not run over rows");
      return nullptr;
  }
}

template <class Real>
auto RowPasses<Real>::planOf(std::span<const PassCall> passes, std::size_t piece) -> Plan& {
  std::deque<Plan>& plans = plans_[piece];
  const auto known = std::find_if(plans.begin(), plans.end(), [&](const Plan& plan) {
    return std::equal(passes.begin(), passes.end(), plan.passes.begin(), plan.passes.end());
  });
  if (known != plans.end()) return *known;
  if (plans.size() == MOST_PLANS) plans.clear();
  Plan& plan = plans.emplace_back();
  plan.piece = piece;
  plan.wave = makeWave(passes, limitColors_[piece]);
  for (const WavePass& pass : plan.wave.passes)
    plan.works.push_back(pass.color != nullptr ? nullptr : rowPassOf(pass.call.pass));
  plan.passes.assign(passes.begin(), passes.end());  // last, so that none is known half made
  return plan;
}

template <class Real>
void RowPasses<Real>::run(std::span<const PassCall> passes,
                          const std::vector<ImplicitArguments<Real>>& pieces) {
  const bool isSweep = sweepLength(passes) == passes.size();
  if (isSweep && passes.front().traits().domain != Domain::springs)
    return runSweep(passes, pieces, 0, pieces.size());
  if (!isSweep && pieces.size() > 1 && runWaves(passes, pieces)) return;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) runOn(piece, passes, pieces);
}

template <class Real>
int RowPasses<Real>::threadsFor(const Piece& lattice) const {
  const ThreadTeam& team = ThreadTeam::shared();
  return std::clamp(lattice.columns * lattice.rows / LEAST_PARTICLES, 1,
                    team.worksAlone() ? 1 : team.threads());
}

template <class Real>
bool RowPasses<Real>::runWaves(std::span<const PassCall> passes,
                               std::span<const ImplicitArguments<Real>> pieces) {
  std::uint32_t particles = 0;
  for (const Piece& lattice : cloth_->pieces()) {
    particles += lattice.particleCount();
    if (lattice.isMesh || lattice.particleCount() >= MOST_SIDE_BY_SIDE) return false;
  }
  const auto count = static_cast<std::uint32_t>(pieces.size());
  if (particles < 2 * LEAST_PARTICLES) return false;
  std::atomic<bool> lacksMemory = false;  // threads must not throw
  waves_.clear();
  for (std::size_t piece = 0; piece < count; ++piece) waves_.push_back(&planOf(passes, piece));
  const std::uint32_t atOnce = std::max(1u, ROW_PARTICLES_AT_ONCE * count / particles);
  ThreadTeam::shared().forEach(0, count, atOnce, [&](std::uint32_t piece) {
    if (!runAlone(*waves_[piece], pieces[piece])) lacksMemory = true;
  });
  if (lacksMemory) throw std::bad_alloc();
  return true;
}

template <class Real>
void RowPasses<Real>::runOn(std::size_t piece, std::span<const PassCall> passes,
                            std::span<const ImplicitArguments<Real>> pieces) {
  const Piece& lattice = cloth_->pieces()[piece];
  if (sweepLength(passes) == passes.size() || lattice.isMesh) return runOneByOne(piece, passes, pieces);
  Plan& plan = planOf(passes, piece);
  const int bands = std::min(threadsFor(lattice), lattice.rows / LEAST_BAND);
  const bool isDone = bands > 1 ? runInBands(plan, bands, pieces[piece]) : runAlone(plan, pieces[piece]);
  if (!isDone) throw std::bad_alloc();
}

template <class Real>
void RowPasses<Real>::runOneByOne(std::size_t piece, std::span<const PassCall> passes,
                                  std::span<const ImplicitArguments<Real>> pieces) {
  while (!passes.empty()) {
    const std::size_t ownRows = sweepLength(passes);
    if (passes.front().traits().domain != Domain::springs)
      runSweep(passes.first(ownRows), pieces, piece, piece + 1);
    else if (passes.front().index < limitColors_[piece].size())
      runColor(piece, limitColors_[piece][passes.front().index], pieces[piece]);
    passes = passes.subspan(ownRows);
  }
}

template <class Real>
void RowPasses<Real>::runSweep(std::span<const PassCall> passes,
                               std::span<const ImplicitArguments<Real>> pieces, std::size_t first,
                               std::size_t end) {
  works_.clear();
  for (const PassCall& call : passes) works_.push_back(rowPassOf(call.pass));
  std::atomic<bool> lacksMemory = false;  // threads must not throw
  static std::atomic<std::uint64_t> sweeps = 0;
  const std::uint64_t sweep = ++sweeps;
  rows_.forEach(rowStarts_[first], rowStarts_[end], rowsAtOnce_, [&](const PieceRange& range) {
    thread_local Sweep<Real> own;
    if (!own.goesOn(sweep, range) && !beginRows(own.forces, cloth_->pieces()[range.piece])) {
      lacksMemory = true;
      return;
    }
    for (std::uint32_t row = range.begin; row < range.end; ++row)
      for (const RowPass work : works_) work(pieces[range.piece], static_cast<int>(row), own.forces);
    own.number = sweep;
    own.last = range;
  });
  if (lacksMemory) throw std::bad_alloc();
}

template <class Real>
void RowPasses<Real>::runColor(std::size_t piece, const LimitColor& color,
                               const ImplicitArguments<Real>& arguments) {
  const Piece& lattice = cloth_->pieces()[piece];
  ThreadTeam::shared().forEach(0, limitRows(lattice, color), rowsAtOnce(lattice),
                               [&](std::uint32_t j) { limitStrain(arguments.step, color, j); });
}

template <class Real>
void RowPasses<Real>::Plan::run(std::size_t k, const ImplicitArguments<Real>& arguments, int row,
                                ForceRows<Real>& forces) const {
  const LimitColor* color = wave.passes[k].color;
  color != nullptr ? limitRow(arguments.step, *color, row) : works[k](arguments, row, forces);
}

template <class Real>
bool RowPasses<Real>::runAlone(const Plan& plan, const ImplicitArguments<Real>& arguments) const {
  const Piece& lattice = cloth_->pieces()[plan.piece];
  thread_local ForceRows<Real> forces;
  if (!forces.begin(lattice.columns)) return false;
  cpu::runWave(plan.wave, lattice.rows, [&](std::size_t k, int row) { plan.run(k, arguments, row, forces); });
  return true;
}

template <class Real>
bool RowPasses<Real>::runInBands(Plan& plan, int count, const ImplicitArguments<Real>& arguments) const {
  const Piece& lattice = cloth_->pieces()[plan.piece];
  const auto bands = static_cast<std::uint32_t>(count);
  if (!plan.bands || plan.bands->count() != bands) plan.bands.emplace(plan.wave, lattice.rows, count);
  std::atomic<bool> lacksMemory = false;
  plan.bands->begin();
  ThreadTeam::shared().forEach(0, bands, 1, [&](std::uint32_t band) {
    const auto work = [&](std::size_t k, int row, ForceRows<Real>& forces) {
      plan.run(k, arguments, row, forces);
    };
    if (!plan.bands->run(band, lattice.columns, work)) lacksMemory = true;
  });
  return !lacksMemory;
}

template class RowPasses<float>;
template class RowPasses<double>;

}  // namespace clothsim::cpu
