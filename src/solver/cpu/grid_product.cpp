#include "solver/cpu/grid_product.h"

#include <algorithm>
#include <array>
#include <utility>

#include "solver/cpu/arrays.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/own_springs.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

// Of the springs in a slot that the particles of a row own, what they add to the owners' products.
template <class Real>
INLINE void multiplySprings(const ImplicitArguments<Real>& arguments, std::uint32_t slot, int row,
                            ForceRows<Real>& rows) {
  const StepParams<Real>& step = arguments.step.step;
  const SpringOffset& offset = springOffsets[slot];
  const bool enabled = (step.enabledSlots >> slot & 1u) != 0;
  if (!enabled || row + offset.rows < 0 || row >= static_cast<int>(step.rows)) return rows.clear(slot, row);
  ImplicitState<Real>& own = arguments.own;
  const Arrays<const Real> x = arraysOf(std::as_const(own.iterate.positions)),
                           p = arraysOf(std::as_const(own.directions.positions));
  const Real *across = own.elements.across[slot].data(), *along = own.elements.along[slot].data();
  const Arrays<Real> products = countedFrom(-rangeOf(step, row).begin, rows.row(slot, row));
  const std::ptrdiff_t other = indexOffset(step, offset.columns, offset.rows);
  const auto multiply = [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      const Vec3<Real> d = at(x, i + other) - at(x, i), e = at(p, i + other) - at(p, i);
      put(products, i, across[i] * e + (along[i] * dot(d, e)) * d);
    }
  };
  forEachSixteen(rangeOf(step, row, offset.columns, offset.columns), multiply);
}

// Of the bending lines whose middles are the particles of a row, what they add to the products of their ends.
template <class Real>
INLINE void multiplyLines(const ImplicitArguments<Real>& arguments, std::size_t kind, int row,
                          ForceRows<Real>& rows) {
  const StepParams<Real>& step = arguments.step.step;
  const bool isAlongRow = kind == ForceRows<Real>::LINE_ALONG_ROW,
             isInside = row >= 1 && row + 1 < static_cast<int>(step.rows);
  if (!isAlongRow && !isInside) return rows.clear(kind, row);
  ImplicitState<Real>& own = arguments.own;
  const Arrays<const Real> p = arraysOf(std::as_const(own.directions.positions));
  const Real* stiffness = (isAlongRow ? own.elements.bendAlongRow : own.elements.bendAlongColumn).data();
  const Arrays<Real> products = countedFrom(-rangeOf(step, row).begin, rows.row(kind, row));
  const std::ptrdiff_t one = isAlongRow ? 1 : indexOffset(step, 0, 1);
  const auto multiply = [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      const Vec3<Real> m = at(p, i);
      put(products, i, stiffness[i] * ((m - at(p, i - one)) + (m - at(p, i + one))));
    }
  };
  forEachSixteen(isAlongRow ? rangeOf(step, row, -1, 1) : rangeOf(step, row), multiply);
}

// What a particle knows of the product with its springs.
template <class Real>
struct Owner {
  Vec3<Real> x, p;
};
template <std::size_t slots, class Real>
INLINE void multiplyOwnSprings(const ImplicitArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  const StepParams<Real>& step = arguments.step.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(step, row);
  const Arrays<const Real> x = countedFrom(all.begin, arraysOf(std::as_const(own.iterate.positions))),
                           p = countedFrom(all.begin, arraysOf(std::as_const(own.directions.positions)));
  std::array<const Real*, slots> across, along;
  std::array<std::ptrdiff_t, slots> others;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    across[slot] = own.elements.across[slot].data() + all.begin;
    along[slot] = own.elements.along[slot].data() + all.begin;
    others[slot] = indexOffset(step, springOffsets[slot].columns, springOffsets[slot].rows);
  }
  computeOwnSprings<slots>(
      rows, row, all.end - all.begin,
      [&](std::ptrdiff_t c) __attribute__((always_inline)) {
        return Owner<Real>{at(x, c), at(p, c)};
      },
      [&](auto slot, std::ptrdiff_t c, int, const Owner<Real>& owner, bool, bool isThere)
          __attribute__((always_inline)) {
            const Vec3<Real> d = at(x, c + others[slot]) - owner.x, e = at(p, c + others[slot]) - owner.p;
            const Vec3<Real> f = across[slot][c] * e + (along[slot][c] * dot(d, e)) * d;
            return Vec3<Real>{isThere ? f.x : Real(0), isThere ? f.y : Real(0), isThere ? f.z : Real(0)};
          });
}

// Of the springs in the first slots; all behind them are empty.
template <std::size_t slots, class Real>
INLINE void multiplySprings(const ImplicitArguments<Real>& arguments, int row, const Arrays<Real>& products,
                            std::ptrdiff_t count, ForceRows<Real>& rows) {
  const auto multiply = [&](int owners) __attribute__((always_inline)) {
    if (canComputeOwnSprings<slots>(arguments.step.step, owners))
      return multiplyOwnSprings<slots>(arguments, owners, rows);
    for (std::uint32_t slot = 0; slot < slots; ++slot) multiplySprings(arguments, slot, owners, rows);
    sumOwnSprings<slots>(rows, owners, count);
  };
  constexpr int reach = slots == SPRING_SLOTS ? 2 : 1;  // rows down to the farthest owner
  rows.ensure(ForceRows<Real>::OWN_SPRINGS, row, row + reach, multiply);
  sumSprings<slots>(rows, row, products, count);
}

// In the order of the forces: incident springs, then lines along the row, then along the column.
template <class Real>
INLINE void multiplyElementsOfRow(const ImplicitArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  const StepParams<Real>& step = arguments.step.step;
  const Range all = rangeOf(step, row);
  const Arrays<Real> products = countedFrom(all.begin, arraysOf(arguments.own.products));
  const std::ptrdiff_t count = all.end - all.begin;
  hasSecondNeighbours(step) ? multiplySprings<SPRING_SLOTS>(arguments, row, products, count, rows)
                            : multiplySprings<NEIGHBOUR_SLOTS>(arguments, row, products, count, rows);
  if (step.hasMaterial == 0) return;
  ensureLines(
      rows, row, [&](std::size_t kind, int middles) __attribute__((always_inline)) {
        multiplyLines(arguments, kind, middles, rows);
      });
  addLines(products, count, row, rows);
}

}  // namespace

template <class Real>
void GridElements<Real>::resize(std::size_t particles) {
  for (auto* slots : {&across, &along})
    for (std::vector<Real>& slot : *slots) slot.assign(particles, Real(0));
  bendAlongRow.assign(particles, Real(0));
  bendAlongColumn.assign(particles, Real(0));
}

template <class Real>
void GridElements<Real>::clear(std::ptrdiff_t begin, std::ptrdiff_t end) {
  const auto clearOne = [&](std::vector<Real>& kept) {
    std::fill(kept.begin() + begin, kept.begin() + end, Real(0));
  };
  for (auto* slots : {&across, &along}) std::for_each(slots->begin(), slots->end(), clearOne);
  clearOne(bendAlongRow);
  clearOne(bendAlongColumn);
}

VECTOR_CLONES(void, multiplyElements,
              (const ImplicitArguments<float>& arguments, int row, ForceRows<float>& rows),
              (arguments, row, rows), multiplyElementsOfRow(arguments, row, rows))
void multiplyElements(const ImplicitArguments<double>& arguments, int row, ForceRows<double>& rows) {
  multiplyElementsOfRow(arguments, row, rows);
}
template struct GridElements<float>;
template struct GridElements<double>;

}  // namespace clothsim::cpu
