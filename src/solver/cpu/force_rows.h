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
#include "solver/cpu/arrays.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

template <class Real>
class ForceRows {
 public:
  // By their owners: springs by slot, then the two triangles of a cell, then the bending lines around a
  // particle.
  static constexpr std::size_t UPPER_TRIANGLE = SPRING_SLOTS, LOWER_TRIANGLE = SPRING_SLOTS + 1,
                               LINE_ALONG_ROW = SPRING_SLOTS + 2, LINE_ALONG_COLUMN = SPRING_SLOTS + 3,
                               KINDS = SPRING_SLOTS + 4;

  // For rows of a grid, ascending and without gaps. Returns whether there is memory for them.
  [[nodiscard]] bool begin(int columns) noexcept try {
    ends_.fill(-AROUND);
    if (columns == columns_) return true;
    columns_ = -1;
    values_.assign(3 * KINDS * KEPT_ROWS * static_cast<std::size_t>(columns + 2 * AROUND), Real(0));
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
    Real* x = values_.data() + 3 * (kind * KEPT_ROWS + place) * stride() + AROUND;
    return {x, x + stride(), x + 2 * stride()};
  }
  INLINE void clear(std::size_t kind, int row) {
    const Arrays<Real> of = this->row(kind, row);
    for (Real* c : {of.x, of.y, of.z}) std::fill_n(c, columns_, Real(0));
  }

 private:
  static constexpr int AROUND = 2;
  static constexpr std::size_t KEPT_ROWS = 3;
  [[nodiscard]] std::size_t stride() const {
    return static_cast<std::size_t>(columns_) + static_cast<std::size_t>(2 * AROUND);
  }

  int columns_ = -1;
  std::array<int, KINDS> ends_{};  // rows before these are there
  std::vector<Real> values_;
};

// work(begin, end) for sixteen particles each, so that a loop over them needs no remainder: the last ones may
// be worked on twice, which must do no harm.
template <class Work>
INLINE void forEachSixteen(Range particles, Work work) {
  constexpr std::ptrdiff_t sixteen = 16;
  const std::ptrdiff_t last = particles.end - sixteen;
  if (last < particles.begin) return work(particles.begin, particles.end);
  for (std::ptrdiff_t begin = particles.begin; begin < last; begin += sixteen) work(begin, begin + sixteen);
  work(last, last + sixteen);
}

// A row of forces by the columns of their owners, and how far from a particle to the owner.
template <class Real>
struct Term {
  Arrays<Real> of;
  std::ptrdiff_t shift;
};

// The sums, or 0, + g or - g for each of the terms, in their order; sums stay in registers meanwhile.
template <bool fromZero, bool... plus, class Real, std::size_t... k>
INLINE void addTerms(const Arrays<Real>& sums, std::ptrdiff_t count,
                     const std::array<Term<Real>, sizeof...(k)>& terms, std::index_sequence<k...>) {
  for (Real* Arrays<Real>::*const component : {&Arrays<Real>::x, &Arrays<Real>::y, &Arrays<Real>::z}) {
    Real* const to = sums.*component;
    const Real* const from[]{terms[k].of.*component + terms[k].shift...};
#pragma GCC ivdep
    for (std::ptrdiff_t c = 0; c < count; ++c) {
      Real sum = fromZero ? Real(0) : to[c];
      ((sum = plus ? sum + from[k][c] : sum - from[k][c]), ...);
      to[c] = sum;
    }
  }
}

// The sums of what springs do to the particles of a row, in the order of incidentSprings, from the rows of
// their owners. What one end feels is exactly the negative of what the other does. Where there is no spring,
// a 0 is added: sums that begin with 0 are never -0, so that nothing changes.
template <class Real>
INLINE void sumSprings(ForceRows<Real>& rows, int row, const Arrays<Real>& sums, std::ptrdiff_t count) {
  const auto sum = [&]<std::size_t... k>(std::index_sequence<k...> all) __attribute__((always_inline)) {
    const auto term = [&](const IncidentSpring& incident) __attribute__((always_inline)) {
      return incident.owned ? Term<Real>{rows.row(incident.slot, row), 0}
                            : Term<Real>{rows.row(incident.slot, row + incident.rows), incident.columns};
    };
    addTerms<true, incidentSprings[k].owned...>(
        sums, count, std::array<Term<Real>, sizeof...(k)>{term(incidentSprings[k])...}, all);
  };
  sum(std::make_index_sequence<incidentSprings.size()>());
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
