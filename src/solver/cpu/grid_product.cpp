#include "solver/cpu/grid_product.h"

#include <algorithm>

#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

constexpr std::size_t SPRINGS = incidentSprings.size();

// Where the incident springs and lines of particle i are found: indices are i + the number.
struct Neighbourhood {
  struct Line {
    std::ptrdiff_t toA, toM, toC, toStiffness;
  };
  std::array<std::ptrdiff_t, SPRINGS> toOther, toBlock;
  std::array<Line, 3> alongRow, alongColumn;  // in which the particle is the last, the middle, the first
};

// Those of a row. What leaves the grid sideways finds an element that is not there, stored as 0, in the next
// row or the one before; what leaves it at row 0 or the last one is sent to row 0, which owns nothing
// upwards.
template <class Real>
INLINE Neighbourhood neighbourhoodOf(const StepParams<Real>& step, int row) {
  const int rows = static_cast<int>(step.rows);
  const std::ptrdiff_t one = indexOffset(step, 0, 1), toRowZero = -row * one;
  Neighbourhood result;
  for (std::size_t k = 0; k < SPRINGS; ++k) {
    const IncidentSpring& spring = incidentSprings[k];
    const bool isThere = row + spring.rows >= 0 && row + spring.rows < rows;
    result.toOther[k] = isThere ? indexOffset(step, spring.columns, spring.rows) : 0;
    result.toBlock[k] = !isThere ? toRowZero : spring.owned ? 0 : result.toOther[k];
  }
  result.alongRow = {{{-2, -1, 0, -1}, {-1, 0, 1, 0}, {0, 1, 2, 1}}};
  for (int k = 0; k < 3; ++k) {
    const bool isThere = row + k - 2 >= 0 && row + k < rows;
    result.alongColumn[static_cast<std::size_t>(k)] =
        isThere ? Neighbourhood::Line{(k - 2) * one, (k - 1) * one, k * one, (k - 1) * one}
                : Neighbourhood::Line{0, 0, 0, toRowZero};
  }
  return result;
}

// That of one particle, without what lies outside the arrays: it is sent to the first particle, which owns
// nothing.
template <class Real>
Neighbourhood inside(Neighbourhood all, const StepParams<Real>& step, std::ptrdiff_t i) {
  const auto end = static_cast<std::ptrdiff_t>(step.totalParticles),
             toFirst = static_cast<std::ptrdiff_t>(step.firstParticle) - i;
  const auto isInside = [&](std::ptrdiff_t offset) { return i + offset >= 0 && i + offset < end; };
  for (std::size_t k = 0; k < SPRINGS; ++k)
    if (!isInside(all.toOther[k])) all.toOther[k] = 0, all.toBlock[k] = toFirst;
  for (Neighbourhood::Line& line : all.alongRow)
    if (!isInside(line.toA) || !isInside(line.toC)) line = {0, 0, 0, toFirst};
  return all;
}

template <class Real>
struct ProductArrays {
  Arrays<const Real> positions, directions;
  Arrays<Real> products;
  std::array<const Real*, SPRING_SLOTS> across, along;
  const Real *bendAlongRow, *bendAlongColumn;
};

// The sums go on in the order of the incident springs, rows before columns, as in the forces.
template <class Real>
INLINE void multiplyParticle(const ProductArrays<Real>& arrays, const Neighbourhood& near, std::ptrdiff_t i) {
  const Vec3<Real> x = at(arrays.positions, i), p = at(arrays.directions, i);
  Vec3<Real> sum{};
#pragma GCC unroll 12
  for (std::size_t k = 0; k < SPRINGS; ++k) {
    const auto slot = static_cast<std::size_t>(incidentSprings[k].slot);
    const Vec3<Real> d = at(arrays.positions, i + near.toOther[k]) - x,
                     e = at(arrays.directions, i + near.toOther[k]) - p;
    const Real across = arrays.across[slot][i + near.toBlock[k]],
               along = arrays.along[slot][i + near.toBlock[k]];
    sum = sum + (across * e + (along * dot(d, e)) * d);
  }
  const auto addLine = [&](const Neighbourhood::Line& line, const Real* stiffness, bool isMiddle)
      __attribute__((always_inline)) {
    const Vec3<Real> a = at(arrays.directions, i + line.toA), m = at(arrays.directions, i + line.toM),
                     c = at(arrays.directions, i + line.toC);
    const Vec3<Real> force = stiffness[i + line.toStiffness] * ((m - a) + (m - c));
    sum = isMiddle ? sum - Real(2) * force : sum + force;
  };
#pragma GCC unroll 3
  for (std::size_t k = 0; k < 3; ++k) addLine(near.alongRow[k], arrays.bendAlongRow, k == 1);
#pragma GCC unroll 3
  for (std::size_t k = 0; k < 3; ++k) addLine(near.alongColumn[k], arrays.bendAlongColumn, k == 1);
  put(arrays.products, i, sum);
}

template <class Real>
INLINE void multiplyElementsOfRow(const ImplicitArguments<Real>& arguments, int row) {
  ImplicitState<Real>& own = arguments.own;
  const StepParams<Real>& step = arguments.step.step;
  ProductArrays<Real> arrays{arraysOf(std::as_const(own.iterate.positions)),
                             arraysOf(std::as_const(own.directions.positions)),
                             arraysOf(own.products),
                             {},
                             {},
                             own.elements.bendAlongRow.data(),
                             own.elements.bendAlongColumn.data()};
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
    arrays.across[slot] = own.elements.across[slot].data();
    arrays.along[slot] = own.elements.along[slot].data();
  }
  const Neighbourhood near = neighbourhoodOf(step, row);
  const Range all = rangeOf(step, row);
  // Springs reach at most so many particles beyond the ends of a row.
  const std::ptrdiff_t reach = indexOffset(step, 2, 1);
  const bool isNearEnd =
      all.begin < reach || all.end + reach > static_cast<std::ptrdiff_t>(step.totalParticles);
  const std::ptrdiff_t border = isNearEnd ? 2 : 0, first = std::min(all.begin + border, all.end),
                       last = std::max(first, all.end - border);
  for (std::ptrdiff_t i = all.begin; i < first; ++i) multiplyParticle(arrays, inside(near, step, i), i);
#pragma GCC ivdep
  for (std::ptrdiff_t i = first; i < last; ++i) multiplyParticle(arrays, near, i);
  for (std::ptrdiff_t i = last; i < all.end; ++i) multiplyParticle(arrays, inside(near, step, i), i);
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

VECTOR_CLONES(void, multiplyElements, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              multiplyElementsOfRow(arguments, row))
void multiplyElements(const ImplicitArguments<double>& arguments, int row) {
  multiplyElementsOfRow(arguments, row);
}
template struct GridElements<float>;
template struct GridElements<double>;

}  // namespace clothsim::cpu
