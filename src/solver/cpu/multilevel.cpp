// From level to level of the implicit integrator's preconditioner; the twin of
// shaders/sim/implicit/{coarsen,restrict,prolong}.comp.
#include <utility>

#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

template <class Real>
INLINE Vec3<Real> at(const Components<Real>& c, std::ptrdiff_t i) {
  return {c.x.data()[i], c.y.data()[i], c.z.data()[i]};
}
template <class Real>
INLINE void put(Components<Real>& c, std::ptrdiff_t i, Vec3<Real> v) {
  c.x.data()[i] = canonical(v.x);
  c.y.data()[i] = canonical(v.y);
  c.z.data()[i] = canonical(v.z);
}

// Along one direction: the fine point of a coarse one, and whether the fine points before and behind it lie
// half way to the next coarse ones.
struct FinePlace {
  std::int64_t middle;
  bool before, behind;
};
INLINE FinePlace finePlace(std::int64_t coarse, std::int64_t coarseCount, std::int64_t fineCount) {
  if (coarseCount == fineCount) return {coarse, false, false};
  const bool last = coarse + 1 == coarseCount;
  const std::int64_t middle = last ? fineCount - 1 : 2 * coarse;
  return {middle, middle > 0 && middle % 2 == 0, !last && middle + 2 < fineCount};
}

// The two coarse points around a fine one, the same one twice where it is one itself.
INLINE std::pair<std::int64_t, std::int64_t> coarsePlaces(std::int64_t fine, std::int64_t coarseCount,
                                                          std::int64_t fineCount) {
  if (coarseCount == fineCount) return {fine, fine};
  if (fine + 1 == fineCount) return {coarseCount - 1, coarseCount - 1};
  return {fine / 2, (fine + 1) / 2};
}

// Sum of `valueAt(fine vertex)`, a whole for the coarse vertex' own place, a half or quarter for those around
// it.
template <class Real, class Value, class ValueAt>
INLINE Value gatherFine(const LevelParams<Real>& level, const FinePlace& row, std::int64_t coarseColumn,
                        ValueAt valueAt) {
  const FinePlace column = finePlace(coarseColumn, level.coarseColumns, level.fineColumns);
  const Value none{};
  const auto alongRow = [&](std::int64_t fineRow) {
    const std::ptrdiff_t i =
        static_cast<std::ptrdiff_t>(level.fineFirst) + fineRow * level.fineColumns + column.middle;
    const Value before = column.before ? valueAt(i - 1) : none,
                behind = column.behind ? valueAt(i + 1) : none;
    return valueAt(i) + Real(0.5) * (before + behind);
  };
  const Value above = row.before ? alongRow(row.middle - 1) : none,
              below = row.behind ? alongRow(row.middle + 1) : none;
  return alongRow(row.middle) + Real(0.5) * (above + below);
}

template <class Real>
INLINE Factors<Real> factorsAt(const ImplicitState<Real>& own, std::ptrdiff_t i) {
  const Symmetric<Real> stored = at(own.factors, i);
  return {stored.others, stored.diagonal};
}

}  // namespace

template <class Real>
void coarsenBlocks(const LevelParams<Real>& level, ImplicitState<Real>& own, int coarseRow) {
  const FinePlace row = finePlace(coarseRow, level.coarseRows, level.fineRows);
  for (std::uint32_t column = 0; column < level.coarseColumns; ++column) {
    const auto sumOf = [&](const SymmetricField<Real>& field) {
      return gatherFine<Real, Symmetric<Real>>(level, row, column,
                                               [&](std::ptrdiff_t i) { return at(field, i); });
    };
    const Symmetric<Real> stretch = sumOf(own.stretch), inertia = sumOf(own.inertia);
    const auto vertex = static_cast<std::ptrdiff_t>(
        level.coarseFirst + static_cast<std::uint32_t>(coarseRow) * level.coarseColumns + column);
    put(own.stretch, vertex, stretch);
    put(own.inertia, vertex, inertia);
    Symmetric<Real> block = level.stretchFactor * stretch + level.inertiaFactor * inertia;
    block.diagonal = block.diagonal + Vec3<Real>{level.bending, level.bending, level.bending};
    const Factors<Real> factors = factorize(block);
    put(own.factors, vertex, {factors.inverse, factors.lower});
  }
}

template <class Real>
void restrictResiduals(const LevelParams<Real>& level, ImplicitState<Real>& own, int coarseRow) {
  const FinePlace row = finePlace(coarseRow, level.coarseRows, level.fineRows);
  for (std::uint32_t column = 0; column < level.coarseColumns; ++column)
    put(own.residuals,
        static_cast<std::ptrdiff_t>(level.coarseFirst +
                                    static_cast<std::uint32_t>(coarseRow) * level.coarseColumns + column),
        gatherFine<Real, Vec3<Real>>(level, row, column,
                                     [&](std::ptrdiff_t i) { return at(own.residuals, i); }));
}

template <class Real>
void prolong(const LevelParams<Real>& level, ImplicitState<Real>& own, const Real* inverseMasses,
             int fineRow) {
  const auto [upper, lower] = coarsePlaces(fineRow, level.coarseRows, level.fineRows);
  const auto first = static_cast<std::ptrdiff_t>(level.coarseFirst);
  const std::ptrdiff_t above = first + upper * level.coarseColumns,
                       below = first + lower * level.coarseColumns;
  for (std::uint32_t column = 0; column < level.fineColumns; ++column) {
    const auto [left, right] = coarsePlaces(column, level.coarseColumns, level.fineColumns);
    const Components<Real>& z = own.corrections;
    const Vec3<Real> around = Real(0.25) * ((at(z, above + left) + at(z, above + right)) +
                                            (at(z, below + left) + at(z, below + right)));
    const auto i = static_cast<std::ptrdiff_t>(
        level.fineFirst + static_cast<std::uint32_t>(fineRow) * level.fineColumns + column);
    const Vec3<Real> correction = solve(factorsAt(own, i), at(own.residuals, i)) + around;
    const bool pinned = inverseMasses != nullptr && inverseMasses[i] == Real(0);
    put(own.corrections, i, pinned ? Vec3<Real>{} : correction);
  }
}

template <class Real>
void solveCoarsest(const LevelParams<Real>& level, ImplicitState<Real>& own, int coarseRow) {
  for (std::uint32_t column = 0; column < level.coarseColumns; ++column) {
    const auto i = static_cast<std::ptrdiff_t>(
        level.coarseFirst + static_cast<std::uint32_t>(coarseRow) * level.coarseColumns + column);
    put(own.corrections, i, solve(factorsAt(own, i), at(own.residuals, i)));
  }
}

template void coarsenBlocks(const LevelParams<float>&, ImplicitState<float>&, int);
template void coarsenBlocks(const LevelParams<double>&, ImplicitState<double>&, int);
template void restrictResiduals(const LevelParams<float>&, ImplicitState<float>&, int);
template void restrictResiduals(const LevelParams<double>&, ImplicitState<double>&, int);
template void prolong(const LevelParams<float>&, ImplicitState<float>&, const float*, int);
template void prolong(const LevelParams<double>&, ImplicitState<double>&, const double*, int);
template void solveCoarsest(const LevelParams<float>&, ImplicitState<float>&, int);
template void solveCoarsest(const LevelParams<double>&, ImplicitState<double>&, int);

}  // namespace clothsim::cpu
