// The prolongation to the particles by sixteen of them, which take each step of their sums together.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/cpu/rows.h"
#include "solver/hierarchy.h"

namespace clothsim::cpu {

template <class Real>
struct ProlongationBySixteen {
  // By which each of sixteen particles hangs on a coarse vertex; 0 if it does not.
  struct alignas(SIXTEEN * sizeof(Real)) Weights {
    std::array<Real, SIXTEEN> of;
  };
  struct Entry {
    std::uint32_t coarse, weights;
  };
  std::vector<std::uint32_t> starts;  // of sixteen particles' entries, and one more
  std::vector<Entry> entries;         // the coarse vertices that any of them hangs on, ascending
  std::vector<Weights> weights;       // once each: on a grid, they recur
};
template <class Real>
[[nodiscard]] ProlongationBySixteen<Real> prolongationBySixteen(const Hierarchy<Real>& hierarchy);

}  // namespace clothsim::cpu
