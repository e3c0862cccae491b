#include "solver/cpu/collider_contacts.h"

#include "solver/cpu/shapes.h"

namespace clothsim::cpu {
namespace {

// A mesh that deforms, as a type of its own.
template <std::uint32_t type, class Real>
INLINE Nearest<Real> nearestOn(const ColliderParams<Real>& shape, Vec3<Real> p, const float* distances) {
  if constexpr (type == COLLIDER_DEFORMS)
    return nearestOnShape<COLLIDER_MESH>(shape, p, distances);
  else if constexpr (type == COLLIDER_MESH)
    return ShapeLaws<Real>{distances}.nearestInGrid(shape, shape.firstSample, p);
  else
    return nearestOnShape<type>(shape, p, distances);
}

template <std::uint32_t type, std::ptrdiff_t count, class Real>
INLINE void findNearestOn(const ColliderParams<Real>& shape, const Lanes<Real>& points,
                          const float* distances, NearestPlaces<Real>& nearest) {
  if (type == COLLIDER_DEFORMS && shape.way == 0) __builtin_unreachable();
#pragma GCC ivdep
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    const Nearest<Real> own = nearestOn<type>(shape, at(points, lane), distances);
    nearest.distances[lane] = own.distance;
    put(nearest.normals, lane, own.normal);
  }
}

template <class Real>
INLINE void findAnyNearest(const ColliderParams<Real>& of, std::ptrdiff_t count, const Lanes<Real>& points,
                           const float* distances, NearestPlaces<Real>& nearest) {
  const ColliderParams<Real> shape = of;  // which no store changes
  const auto find = [&]<std::uint32_t type>() __attribute__((always_inline)) {
    count == 1 ? findNearestOn<type, 1>(shape, points, distances, nearest)
               : findNearestOn<type, SIXTEEN>(shape, points, distances, nearest);
  };
  switch (shape.way != 0 && shape.type == COLLIDER_MESH ? COLLIDER_DEFORMS : shape.type) {
#define CASE(number, Struct, law) \
  case number:                    \
    return find.template operator()<number>();
    DISTANCE_SHAPES(CASE)
    CASE(COLLIDER_DEFORMS, , )
#undef CASE
  }
}

template <std::ptrdiff_t count, class Real>
INLINE void deformBy(const ColliderParams<Real>& body, Lanes<Real>& points, const float* distances) {
#pragma GCC ivdep
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    const Vec3<Real> x = at(points, lane);
    put(points, lane,
        x + toWorld(body, ShapeLaws<Real>{distances}.deformationNear(body, toOwnFrame(body, x))));
  }
}
template <class Real>
INLINE void deformAny(const ColliderParams<Real>& of, std::ptrdiff_t count, Lanes<Real>& points,
                      const float* distances) {
  const ColliderParams<Real> body = of;  // which no store changes
  count == 1 ? deformBy<1>(body, points, distances) : deformBy<SIXTEEN>(body, points, distances);
}

}  // namespace

VECTOR_CLONES(void, findNearest,
              (const ColliderParams<float>& shape, std::ptrdiff_t count, const Lanes<float>& points,
               const float* distances, NearestPlaces<float>& nearest),
              (shape, count, points, distances, nearest),
              findAnyNearest(shape, count, points, distances, nearest))
void findNearest(const ColliderParams<double>& shape, std::ptrdiff_t count, const Lanes<double>& points,
                 const float* distances, NearestPlaces<double>& nearest) {
  findAnyNearest(shape, count, points, distances, nearest);
}
VECTOR_CLONES(void, deform,
              (const ColliderParams<float>& body, std::ptrdiff_t count, Lanes<float>& points,
               const float* distances),
              (body, count, points, distances), deformAny(body, count, points, distances))
void deform(const ColliderParams<double>& body, std::ptrdiff_t count, Lanes<double>& points,
            const float* distances) {
  deformAny(body, count, points, distances);
}

}  // namespace clothsim::cpu
