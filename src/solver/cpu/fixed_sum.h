// Sums over all particles in an order that depends on nothing but their number (shared/implicit.h); the twin
// of shaders/sim/implicit/total.glsl.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/cpu/arrays.h"

namespace clothsim::cpu {

// Of a[i].b[i], and of a[i]. `partials` is scratch.
template <class Real>
[[nodiscard]] Real fixedSum(const Components<Real>& a, const Components<Real>& b,
                            std::vector<Real>& partials);
template <class Real>
[[nodiscard]] Real fixedSum(const std::vector<Real>& a, std::vector<Real>& partials);

}  // namespace clothsim::cpu
