// What a triangle of a membrane does; the twin of shaders/sim/membrane.glsl. Edge k goes from corner k + 1 to
// corner k + 2; with e_k = (l_k^2 - L_k^2) / 2 the energy is 1/2 |R e|^2 and t = R^T R e the tension of each
// edge over its length (H. Delingette, "Triangular springs for modeling nonlinear membranes", 2008; P. Volino
// et al., "A simple approach to nonlinear tensile stiffness for accurate cloth simulation", 2009).
#pragma once

#include <array>

#include "solver/cpu/cpu_state.h"
#include "solver/cpu/rows.h"
#include "solver/mesh_lists.h"

namespace clothsim::cpu {

template <class Real>
using OfEdges = std::array<Real, 3>;

template <class Real>
INLINE std::array<Vec3<Real>, 3> edgesOf(const std::array<std::uint32_t, 3>& corners,
                                         const Components<Real>& field) {
  const auto at = [&](std::uint32_t i) { return Vec3<Real>{field.x[i], field.y[i], field.z[i]}; };
  const Vec3<Real> a = at(corners[0]), b = at(corners[1]), c = at(corners[2]);
  return {c - b, a - c, b - a};
}

// R v.
template <class Real>
INLINE OfEdges<Real> timesRoots(const std::array<Real, 6>& roots, const OfEdges<Real>& v) {
  const auto& [xx, xy, xz, yy, yz, zz] = roots;
  return {(xx * v[0] + xy * v[1]) + xz * v[2], yy * v[1] + yz * v[2], zz * v[2]};
}
// R^T R v.
template <class Real>
INLINE OfEdges<Real> timesMatrix(const std::array<Real, 6>& roots, const OfEdges<Real>& v) {
  const auto& [xx, xy, xz, yy, yz, zz] = roots;
  const OfEdges<Real> w = timesRoots(roots, v);
  return {xx * w[0], xy * w[0] + yy * w[1], (xz * w[0] + yz * w[1]) + zz * w[2]};
}

// e, of edges d.
template <class Real>
INLINE OfEdges<Real> strainsOf(const OfEdges<Real>& restSquared, const std::array<Vec3<Real>, 3>& d) {
  OfEdges<Real> e;
  for (std::size_t k = 0; k < 3; ++k) e[k] = Real(0.5) * (dot(d[k], d[k]) - restSquared[k]);
  return e;
}

// The force on a corner where edge k pulls by pulls[k].
template <class Real>
INLINE Vec3<Real> pullAt(std::uint32_t corner, const std::array<Vec3<Real>, 3>& pulls) {
  const std::size_t next = corner == 2 ? 0 : corner + 1, last = corner == 0 ? 2 : corner - 1;
  return pulls[last] - pulls[next];
}

// The tensions that the implicit integrator takes into its matrix: those of a triangle that pulls in all
// directions, which is where sum t (D.g)^2 over its edges D is positive for all g; else those that pull.
template <class Real>
INLINE OfEdges<Real> positiveTensions(const std::array<Real, 6>& roots, const OfEdges<Real>& e) {
  OfEdges<Real> t = timesMatrix(roots, e);
  for (Real& tension : t) tension = canonical(tension);
  const Real sum = (t[0] + t[1]) + t[2], determinant = (t[0] * t[1] + t[1] * t[2]) + t[2] * t[0];
  const bool pulls = sum > Real(0) && determinant > Real(0);
  for (Real& tension : t) tension = pulls || tension > Real(0) ? tension : Real(0);
  return t;
}

}  // namespace clothsim::cpu
