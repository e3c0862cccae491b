// Room for the forces of springs, triangles and bending lines of the rows about the one that is worked on, so
// that each is computed once for all particles that it acts on. Passes that go down the rows together must
// not share them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

#include "cloth/cloth.h"
#include "core/cache_line.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

template <class Real>
class ForceRows {
 public:
  // By their owners: springs by slot, and their sum; then the two triangles of a cell, then the bending lines
  // around a particle.
  static constexpr std::size_t OWN_SPRINGS = SPRING_SLOTS, UPPER_TRIANGLE = SPRING_SLOTS + 1,
                               LOWER_TRIANGLE = SPRING_SLOTS + 2, LINE_ALONG_ROW = SPRING_SLOTS + 3,
                               LINE_ALONG_COLUMN = SPRING_SLOTS + 4, KINDS = SPRING_SLOTS + 5;

  // For rows of a grid, ascending and without gaps. Returns whether there is memory for them.
  [[nodiscard]] bool begin(int columns) noexcept try {
    ends_.fill(-AROUND);
    if (columns == columns_) return true;
    columns_ = -1;
    stride_ = strideFor(static_cast<std::size_t>(columns));
    values_.assign(3 * KINDS * KEPT_ROWS * stride_ + 2 * LINE, Real(0));
    columns_ = columns;
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
  // Calls compute(row) for the rows of a kind from `first` to `last` that are not there yet.
  template <class Compute>
  INLINE void ensure(std::size_t kind, int first, int last, Compute compute) {
    for (int row = std::max(ends_[kind], first); row <= last; ++row) compute(row);
    ends_[kind] = std::max(ends_[kind], last + 1);
  }
  // Of the owners in a row, by column. Up to AROUND columns before the first and behind the last there are
  // zeros; rows may lie up to AROUND before the grid, too.
  [[nodiscard]] INLINE Arrays<Real> row(std::size_t kind, int row) {
    const auto place = static_cast<std::size_t>(row + AROUND) % KEPT_ROWS;
    Real* x = lineAt(values_.data()) + 3 * (kind * KEPT_ROWS + place) * stride_ + LINE;
    return {x, x + stride_, x + 2 * stride_};
  }
  INLINE void clear(std::size_t kind, int row) {
    const Arrays<Real> of = this->row(kind, row);
    for (Real* c : {of.x, of.y, of.z}) std::fill_n(c, columns_, Real(0));
  }

 private:
  static constexpr int AROUND = 2;
  static constexpr std::size_t KEPT_ROWS = 3;
  static constexpr std::size_t LINE = LINE_NUMBERS<Real>;
  // Whole lines with the zeros around; an odd number, so that rows do not share their places in the cache.
  static std::size_t strideFor(std::size_t columns) {
    static_assert(AROUND <= static_cast<int>(LINE));
    return (((columns + LINE - 1) / LINE + 1) | 1) * LINE;
  }

  int columns_ = -1;
  std::size_t stride_ = 0;
  std::array<int, KINDS> ends_{};  // rows before these are there
  std::vector<Real> values_;
};

// A row of forces by the columns of their owners, and how far from a particle to the owner.
template <class Real>
struct Term {
  Arrays<Real> of;
  std::ptrdiff_t shift;
};

// sums = first + g or - g for each of the terms, in their order; sums stay in registers meanwhile.
template <bool... plus, class Real, std::size_t... k>
INLINE void addTerms(const Arrays<Real>& sums, const Arrays<Real>& first, std::ptrdiff_t count,
                     const std::array<Term<Real>, sizeof...(k)>& terms, std::index_sequence<k...>) {
  for (Real* Arrays<Real>::*const component : {&Arrays<Real>::x, &Arrays<Real>::y, &Arrays<Real>::z}) {
    Real *const to = sums.*component, *const start = first.*component;
    const Real* const from[]{terms[k].of.*component + terms[k].shift...};
#pragma GCC ivdep
    for (std::ptrdiff_t c = 0; c < count; ++c) {
      Real sum = start[c];
      ((sum = plus ? sum + from[k][c] : sum - from[k][c]), ...);
      to[c] = sum;
    }
  }
}

// The sums of what the springs that the particles of a row own in the first slots do to them, from the rows
// of the slots.
template <std::size_t slots, class Real>
INLINE void sumOwnSprings(ForceRows<Real>& rows, int row, std::ptrdiff_t count) {
  const Arrays<Real> sums = rows.row(ForceRows<Real>::OWN_SPRINGS, row);
  for (Real* c : {sums.x, sums.y, sums.z}) std::fill_n(c, count, Real(0));
  const auto sum = [&]<std::size_t... k>(std::index_sequence<k...> all) __attribute__((always_inline)) {
    addTerms<(k < slots)...>(sums, sums, count,
                             std::array<Term<Real>, sizeof...(k)>{Term<Real>{rows.row(k, row), 0}...}, all);
  };
  sum(std::make_index_sequence<slots>());
}
// Those of incidentSprings in the first slots that a particle does not own itself.
template <std::size_t slots>
inline constexpr auto notOwned = [] {
  std::array<IncidentSpring, slots> result{};
  std::size_t count = 0;
  for (const IncidentSpring& spring : incidentSprings)
    if (!spring.owned && static_cast<std::size_t>(spring.slot) < slots) result[count++] = spring;
  return result;
}();
// The sums of what springs in the first slots do to the particles of a row, in the order of incidentSprings:
// after those that they own come the others, from the rows of their owners. What one end feels is exactly the
// negative of what the other does. Where there is no spring, a 0 is added: sums that begin with 0 are never
// -0, so that nothing changes.
template <std::size_t slots, class Real>
INLINE void sumSprings(ForceRows<Real>& rows, int row, const Arrays<Real>& sums, std::ptrdiff_t count) {
  const auto sum = [&]<std::size_t... k>(std::index_sequence<k...> all) __attribute__((always_inline)) {
    const auto term = [&](const IncidentSpring& spring) __attribute__((always_inline)) {
      return Term<Real>{rows.row(spring.slot, row + spring.rows), spring.columns};
    };
    addTerms<(k == slots)...>(sums, rows.row(ForceRows<Real>::OWN_SPRINGS, row), count,
                              std::array<Term<Real>, slots>{term(notOwned<slots>[k])...}, all);
  };
  sum(std::make_index_sequence<slots>());
}

// Calls compute(kind, row) for the bending lines that act on the particles of a row and are not there yet.
template <class Real, class Compute>
INLINE void ensureLines(ForceRows<Real>& rows, int row, Compute compute) {
  const auto ensure = [&](std::size_t kind, int around) __attribute__((always_inline)) {
    rows.ensure(
        kind, row - around,
        row + around, [&](int middles) __attribute__((always_inline)) { compute(kind, middles); });
  };
  ensure(ForceRows<Real>::LINE_ALONG_ROW, 0);
  ensure(ForceRows<Real>::LINE_ALONG_COLUMN, 1);
}

// Adds what bending lines do to the particles of a row, of which each is the last, the middle and the first
// of three lines along the row, then along the column. The middle feels -2 times what an end does.
template <class Real>
INLINE void addLines(const Arrays<Real>& sums, std::ptrdiff_t count, int row, ForceRows<Real>& rows) {
  constexpr std::size_t alongRow = ForceRows<Real>::LINE_ALONG_ROW,
                        alongColumn = ForceRows<Real>::LINE_ALONG_COLUMN;
  const Arrays<Real> inRow = rows.row(alongRow, row), above = rows.row(alongColumn, row - 1),
                     here = rows.row(alongColumn, row), below = rows.row(alongColumn, row + 1);
#pragma GCC ivdep
  for (std::ptrdiff_t c = 0; c < count; ++c) {
    const Vec3<Real> ofRow = ((at(sums, c) + at(inRow, c - 1)) - Real(2) * at(inRow, c)) + at(inRow, c + 1);
    put(sums, c, ((ofRow + at(above, c)) - Real(2) * at(here, c)) + at(below, c));
  }
}

}  // namespace clothsim::cpu
