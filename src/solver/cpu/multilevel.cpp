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
  const std::int64_t middle = finePoint(coarse, coarseCount, fineCount);
  return {middle, middle > 0 && middle % 2 == 0, coarse + 1 < coarseCount && middle + 2 < fineCount};
}

// The two coarse points around a fine one, the same one twice where it is one itself.
INLINE std::pair<std::int64_t, std::int64_t> coarsePlaces(std::int64_t fine, std::int64_t coarseCount,
                                                          std::int64_t fineCount) {
  if (coarseCount == fineCount) return {fine, fine};
  if (fine + 1 == fineCount) return {coarseCount - 1, coarseCount - 1};
  return {fine / 2, (fine + 1) / 2};
}

template <class Real>
INLINE std::uint32_t cutLinksOf(const ImplicitState<Real>& own, std::ptrdiff_t i) {
  return own.cutLinks.empty() ? 0 : own.cutLinks.data()[i];
}

// Sum of `valueAt(fine vertex)`, a whole for the coarse vertex' own place, a half or quarter for those around
// it that it is not cut off from.
template <class Real, class Value, class ValueAt>
INLINE Value gatherFine(const LevelParams<Real>& level, const ImplicitState<Real>& own, const FinePlace& row,
                        std::int64_t coarseColumn, ValueAt valueAt) {
  const FinePlace column = finePlace(coarseColumn, level.coarseColumns, level.fineColumns);
  const std::ptrdiff_t middle =
      static_cast<std::ptrdiff_t>(level.fineFirst) + row.middle * level.fineColumns + column.middle;
  const std::uint32_t links = cutLinksOf(own, middle);
  const auto valueOf = [&](int columns, int rows) {
    return (links & LINK_BIT(columns, rows)) != 0
               ? Value{}
               : valueAt(middle + rows * std::ptrdiff_t{level.fineColumns} + columns);
  };
  const auto alongRow = [&](int rows) {
    const Value before = column.before ? valueOf(-1, rows) : Value{},
                behind = column.behind ? valueOf(1, rows) : Value{};
    return valueOf(0, rows) + Real(0.5) * (before + behind);
  };
  const Value above = row.before ? alongRow(-1) : Value{}, below = row.behind ? alongRow(1) : Value{};
  return alongRow(0) + Real(0.5) * (above + below);
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
      return gatherFine<Real, Symmetric<Real>>(level, own, row, column,
                                               [&](std::ptrdiff_t i) { return at(field, i); });
    };
    const Symmetric<Real> stiffness = sumOf(own.stiffness), inertia = sumOf(own.inertia);
    const auto vertex = static_cast<std::ptrdiff_t>(
        level.coarseFirst + static_cast<std::uint32_t>(coarseRow) * level.coarseColumns + column);
    put(own.stiffness, vertex, stiffness);
    put(own.inertia, vertex, inertia);
    Symmetric<Real> block = level.stiffnessFactor * stiffness + level.inertiaFactor * inertia;
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
        gatherFine<Real, Vec3<Real>>(level, own, row, column,
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
    const auto i = static_cast<std::ptrdiff_t>(
        level.fineFirst + static_cast<std::uint32_t>(fineRow) * level.fineColumns + column);
    const std::uint32_t links = cutLinksOf(own, i);
    const int columns = left == right ? 0 : 1, rows = upper == lower ? 0 : 1;
    const auto from = [&](std::ptrdiff_t vertex, std::uint32_t link) {
      return (links & link) != 0 ? Vec3<Real>{} : at(own.corrections, vertex);
    };
    const Vec3<Real> around =
        Real(0.25) *
        ((from(above + left, LINK_BIT(-columns, -rows)) + from(above + right, LINK_BIT(columns, -rows))) +
         (from(below + left, LINK_BIT(-columns, rows)) + from(below + right, LINK_BIT(columns, rows))));
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
