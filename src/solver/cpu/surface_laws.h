// What the laws in shaders/shared/surface_laws.h are written in, as C++.
#pragma once

#include <cstdint>

#include "core/exact_math.h"
#include "core/vec.h"
#include "core/vector_clones.h"
#include "shared/surface.h"

namespace clothsim::cpu {

#include "solver/cpu/begin_laws.h"

template <class Real>
struct SurfaceLaws {
  using real = Real;
  using uint = std::uint32_t;
  using vec3 = Vec3<Real>;
  using SmallCollider = const shared::SmallCollider<Real>&;

  INLINE static real sumOfProducts(vec3 a, vec3 b) { return dot(a, b); }
  INLINE static vec3 crossProduct(vec3 a, vec3 b) { return cross(a, b); }
  INLINE static real inverseSquareRoot(real x) { return clothsim::inverseSquareRoot(x); }
  INLINE static real reciprocal(real x) { return clothsim::reciprocal(x); }
  INLINE static vec3 canonical(vec3 v) {
    return {clothsim::canonical(v.x), clothsim::canonical(v.y), clothsim::canonical(v.z)};
  }

#undef LAW
#define LAW INLINE static
#include "shared/surface_laws.h"
// which these need:
#include "shared/core_laws.h"
};

#include "solver/cpu/end_laws.h"

}  // namespace clothsim::cpu
