// The springs that the particles of a row of a grid own, all slots at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "solver/cpu/arrays.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

// Sixteen particles of a row: the first and the last ones lack springs across the border.
enum class RowPart { first, inside, last };
// So that the last ones own all springs to the left.
inline constexpr std::ptrdiff_t LEAST_COLUMNS = SIXTEEN + 2;
// Whether computeOwnSprings() may do a row of owners.
template <std::size_t slots, class Real>
INLINE bool canComputeOwnSprings(const StepParams<Real>& step, int row) {
  return step.enabledSlots == (1u << slots) - 1 &&
         static_cast<std::ptrdiff_t>(step.columns) >= LEAST_COLUMNS && row >= 2 &&
         row < static_cast<int>(step.rows);
}
// What the springs that the particles of a row own in the first slots do, at once: their chains of operations
// overlap. ownAt(column) is what is known of an owner; forceOf(slot, column, lane, own, isEnd, isThere) what
// the spring does to it. `isEnd`: the owner is the first or the last of its row; of a spring that is not
// there it says 0.
template <std::size_t slots, class Real, class OwnAt, class ForceOf>
INLINE void computeOwnSprings(ForceRows<Real>& rows, int row, std::ptrdiff_t count, OwnAt ownAt,
                              ForceOf forceOf) {
  const auto all = [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
    const Arrays<Real> forces[]{rows.row(k, row)...}, sums = rows.row(ForceRows<Real>::OWN_SPRINGS, row);
    const auto compute = [&]<RowPart part>(std::ptrdiff_t begin) __attribute__((always_inline)) {
#pragma GCC ivdep
      for (int lane = 0; lane < SIXTEEN; ++lane) {
        const std::ptrdiff_t column = begin + lane;
        const auto own = ownAt(column);
        Vec3<Real> sum{};
        const auto add = [&](auto slot) __attribute__((always_inline)) {
          constexpr int columns = springOffsets[slot].columns;
          const bool isEnd =
              (part == RowPart::first && lane == 0) | (part == RowPart::last && lane == SIXTEEN - 1);
          const bool isThere = !(part == RowPart::first && lane + columns < 0) &
                               !(part == RowPart::last && lane + columns >= SIXTEEN);
          const Vec3<Real> f = forceOf(slot, column, lane, own, isEnd, isThere);
          forces[slot].x[column] = f.x;
          forces[slot].y[column] = f.y;
          forces[slot].z[column] = f.z;
          sum = {sum.x + f.x, sum.y + f.y, sum.z + f.z};
        };
        (add(std::integral_constant<std::size_t, k>()), ...);
        sums.x[column] = sum.x;
        sums.y[column] = sum.y;
        sums.z[column] = sum.z;
      }
    };
    compute.template operator()<RowPart::first>(0);
    for (std::ptrdiff_t begin = SIXTEEN; begin < count - SIXTEEN; begin += SIXTEEN)
      compute.template operator()<RowPart::inside>(std::min(begin, count - SIXTEEN - 1));
    compute.template operator()<RowPart::last>(count - SIXTEEN);
  };
  all(std::make_index_sequence<slots>());
}

}  // namespace clothsim::cpu
