// Room for the forces of springs and triangles of the rows about the one that is worked on, so that each is
// computed once for all particles that it acts on.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>
#include <vector>

#include "cloth/cloth.h"
#include "solver/cpu/arrays.h"

namespace clothsim::cpu {

template <class Real>
class ForceRows {
 public:
  // By their owners: springs by slot, then the two triangles of a cell.
  static constexpr std::size_t UPPER_TRIANGLE = SPRING_SLOTS, LOWER_TRIANGLE = SPRING_SLOTS + 1,
                               KINDS = SPRING_SLOTS + 2;

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
  [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(columns_ + 2 * AROUND); }

  int columns_ = -1;
  std::array<int, KINDS> ends_{};  // rows before these are there
  std::vector<Real> values_;
};

}  // namespace clothsim::cpu
