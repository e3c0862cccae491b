// What the laws in shaders/shared/shapes/ are written in, as C++: signed distances of the colliders' shapes
// in their own frames. All are exact, inside as well as outside (formulas as in Inigo Quilez, "Distance
// functions", with the normals worked out by hand).
#pragma once

#include <type_traits>

#include "core/exact_math.h"
#include "scene/colliders/collider_set.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

// The nearest place of a surface, seen from a point.
template <class Real>
struct Nearest {
  Real distance;      // [m], negative inside
  Vec3<Real> normal;  // outward there
};

#define Nearest(distance, normal) \
  Nearest { distance, normal }
#include "solver/cpu/begin_laws.h"

template <class Real>
struct ShapeLaws {
  using real = Real;
  using uint = std::uint32_t;
  using vec3 = Vec3<Real>;
  using Nearest = cpu::Nearest<Real>;
  using ColliderParams = const shared::ColliderParams<Real>&;

  const float* distances;  // samples of the meshes

  INLINE static constexpr bool hasType(uint) {
    return true;
  }  // on the GPU what a scene lacks is compiled out
  INLINE real distanceSample(uint i) const { return static_cast<real>(distances[i]); }
  INLINE static real sumOfProducts(vec3 a, vec3 b) { return dot(a, b); }
  INLINE static vec3 canonical(vec3 v) {
    return {clothsim::canonical(v.x), clothsim::canonical(v.y), clothsim::canonical(v.z)};
  }

#include "shared/shapes.h"
};

#include "solver/cpu/end_laws.h"
#undef Nearest

template <std::uint32_t type, class Real>
INLINE Nearest<Real> nearestOnShape(const ColliderParams<Real>& shape, Vec3<Real> p,
                                    const float* distances = nullptr) {
#define NEAREST_IF(number, Struct, law) \
  if constexpr (type == number) return ShapeLaws<Real>{distances}.law(shape, p);
  DISTANCE_SHAPES(NEAREST_IF)
#undef NEAREST_IF
}

// The same for a shape of a type that is known when it runs.
template <class Real>
Nearest<Real> nearestOnShape(const ColliderParams<Real>& shape, Vec3<Real> p, const float* distances) {
  switch (shape.type) {
#define CASE(number, Struct, law) \
  case number:                    \
    return nearestOnShape<number>(shape, p, distances);
    DISTANCE_SHAPES(CASE)
#undef CASE
  }
  return {};
}

// Each number is the place of its shape among the alternatives of Collider, and none is missing.
#define PLACE_OF(number, Struct, law) \
  static_assert(std::is_same_v<std::variant_alternative_t<number, Collider>, Struct>);
DISTANCE_SHAPES(PLACE_OF)
PLACE_OF(COLLIDER_SPHERE, Sphere, )
PLACE_OF(COLLIDER_PLANE, Plane, )
#undef PLACE_OF
#define ONE(number, Struct, law) +1
static_assert(2 DISTANCE_SHAPES(ONE) == std::variant_size_v<Collider>, "a shape without a law");
#undef ONE

}  // namespace clothsim::cpu
