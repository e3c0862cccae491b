// The product of an implicit step's matrix with directions, for the springs and bending lines of a row of a
// grid: what they are at an iterate is kept by linearize(), and many products use it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cloth/cloth.h"

namespace clothsim::cpu {

template <class Real>
struct ImplicitArguments;
template <class Real>
class ForceRows;

// Springs and bending lines at an iterate, an entry a particle; 0 where there is none. For grids.
template <class Real>
struct GridElements {
  // SpringBlock of the springs that a particle owns, by slot.
  std::array<std::vector<Real>, SPRING_SLOTS> across, along;
  // Bending stiffness of the lines whose middle a particle is [N/m].
  std::vector<Real> bendAlongRow, bendAlongColumn;

  void resize(std::size_t particles);
  // Nothing is at the particles [begin, end).
  void clear(std::ptrdiff_t begin, std::ptrdiff_t end);
};

// products = minus what springs and bending add to H directions, of a row of a grid; `rows` as of
// gatherForces().
void multiplyElements(const ImplicitArguments<float>& arguments, int row, ForceRows<float>& rows);
void multiplyElements(const ImplicitArguments<double>& arguments, int row, ForceRows<double>& rows);

}  // namespace clothsim::cpu
