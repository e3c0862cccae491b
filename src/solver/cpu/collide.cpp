#include "solver/cpu/collide.h"

#include <algorithm>
#include <utility>

#include "solver/cpu/arrays.h"
#include "solver/cpu/collider_frames.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/shapes.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {
namespace {

template <class Real>
INLINE Vec3<Real> select(bool which, Vec3<Real> a, Vec3<Real> b) {
  return {which ? a.x : b.x, which ? a.y : b.y, which ? a.z : b.z};
}

template <class Real>
struct Contact {
  bool touches;
  Vec3<Real> outward;  // to the surface, where the particle goes without friction
  Vec3<Real> normal;   // of the collider there, outward
  Real depth;          // how far that is along the normal [m]
};

// Inside the sphere: the nearest point of its surface. A particle that a long step took through the sphere,
// or to where another side of it is nearer, goes to the point where its way entered: the smaller root of
// |previous + t (x - previous) - center| = radius. `mayEnter`: the way may be that long.
template <bool mayEnter, class Real>
INLINE Contact<Real> sphereContact(const ColliderParams<Real>& sphere, Vec3<Real> previous, Vec3<Real> x) {
  const Vec3<Real> center = pointOf(sphere);
  const Vec3<Real> d = x - center;
  const Real distanceSquared = dot(d, d);
  const Real inverseDistance = inverseSquareRoot(distanceSquared);
  const Real distance = distanceSquared * inverseDistance;
  const bool inside = distanceSquared < sphere.radiusSquared;
  if constexpr (!mayEnter) {
    const Vec3<Real> normal = inverseDistance * d;
    const Real depth = sphere.radius - distance;
    return {inside, depth * normal, normal, depth};
  }

  const Vec3<Real> way = x - previous;
  const Vec3<Real> from = previous - center;
  const Real waySquared = dot(way, way);
  const Real along = dot(from, way);
  const Real fromSquared = dot(from, from);
  const Real alongSquared = along * along;
  const Real beyond = along + waySquared;
  const Real deeper = waySquared * (fromSquared - sphere.grazeSquared);
  const Real discriminant = alongSquared - waySquared * (fromSquared - sphere.radiusSquared);
  const Real root = Real(0) < discriminant ? discriminant * inverseSquareRoot(discriminant) : Real(0);
  const Real inverseWay = inverseSquareRoot(waySquared);
  const Real t = ((-along) - root) * (inverseWay * inverseWay);
  const Vec3<Real> entryNormal = (sphere.inverseRadius * (from + t * way));
  const Vec3<Real> toEntry = sphere.radius * entryNormal - d;
  const Real facing = dot(entryNormal, d);
  const Real sameSide = Real(0.5) * distance;
  const bool sweeps = (sphere.sweepSquared < waySquared) & (along < Real(0));
  const bool passed = sweeps & !inside & (Real(0) < beyond) & (deeper < alongSquared);
  const bool otherSide = sweeps & inside & (facing < sameSide);
  const bool entered = passed | otherSide;

  const Vec3<Real> normal = select(entered, entryNormal, inverseDistance * d);
  const Real depth = entered ? sphere.radius - facing : sphere.radius - distance;
  const Vec3<Real> outward = select(entered, toEntry, depth * normal);
  const bool touches = inside | passed;
  return {touches, outward, normal, depth};
}

// CS184's plane, crossed since `previous`: the foot of the perpendicular, a little off on the side it came
// from.
template <class Real>
INLINE Contact<Real> crossedPlane(const ColliderParams<Real>& plane, Real offset, Vec3<Real> previous,
                                  Vec3<Real> x) {
  const Vec3<Real> normal{plane.normalX, plane.normalY, plane.normalZ};
  const Real heightBefore = dot(previous - pointOf(plane), normal);
  const Real height = dot(x - pointOf(plane), normal);
  const bool wasAbove = !(heightBefore < Real(0));
  const bool isAbove = !(height < Real(0));
  const Real side = wasAbove ? offset : -offset;
  const Real lift = side - height;
  return {wasAbove != isAbove, lift * normal, normal, lift};
}

// A plane that is solid behind its normal: the foot of the perpendicular.
template <class Real>
INLINE Contact<Real> solidPlane(const ColliderParams<Real>& plane, Vec3<Real> x) {
  const Vec3<Real> normal{plane.normalX, plane.normalY, plane.normalZ};
  const Real height = dot(x - pointOf(plane), normal);
  return {height < Real(0), (-height) * normal, normal, -height};
}

// Where the surface of a body that deforms takes in the step what was at x at its start.
template <std::uint32_t type, class Real>
INLINE Vec3<Real> deformed(const ColliderParams<Real>& shape, Vec3<Real> x, const float* distances) {
  if constexpr (type == COLLIDER_MESH)
    if (shape.way != 0)
      return x + toWorld(shape, ShapeLaws<Real>{distances}.deformationNear(shape, toOwnFrame(shape, x)));
  return x;
}

// Where a point was at the start of the step, carried along with the collider.
template <class Real>
INLINE Vec3<Real> previousOf(const PassArguments<Real>& arguments, const ColliderParams<Real>& collider,
                             Vec3<Real> start) {
  const Vec3<Real> rigid = collider.moving != 0 ? carried(collider, start) : start;
  return collider.type == COLLIDER_MESH ? deformed<COLLIDER_MESH>(collider, rigid, arguments.distances)
                                        : rigid;
}

// A shape known by its signed distance. A particle inside goes to the nearest point of the surface, provided
// that this is on the side where it came in: the normals there and at the entry are less than 60 degrees
// apart. Otherwise it goes back to the tangent plane at the entry. A particle that is outside on another
// side, having gone through, goes to the entry itself; grazing ways around an edge do not count as going
// through.
template <std::uint32_t type, class Real>
INLINE Contact<Real> shapeContact(const ColliderParams<Real>& shape, Vec3<Real> previous, Vec3<Real> x,
                                  const float* distances) {
  const Vec3<Real> b = toOwnFrame(shape, x);
  const Nearest<Real> end = nearestOnShape<type>(shape, b, distances);
  const Vec3<Real> moved = x - previous;
  const Real movedSquared = dot(moved, moved);
  const Real distanceSquared = end.distance * end.distance;
  // No place of the way is nearer than the distance at its end less its length.
  if ((Real(0) < end.distance) & (movedSquared < distanceSquared)) return {false, {}, end.normal, Real(0)};

  const Vec3<Real> a = toOwnFrame(shape, previous);
  const Vec3<Real> way = b - a;
  const Real waySquared = dot(way, way);
  const Real inverseWay = inverseSquareRoot(waySquared);
  const Real wayLength = waySquared * inverseWay;
  // Sphere tracing (Hart, 1996): going on by the distance never oversteps the surface. From inside, the entry
  // is taken to be the nearest point of the surface.
  Real t = Real(0);
  Vec3<Real> place = a;
  Nearest<Real> entry = nearestOnShape<type>(shape, a, distances);
  for (int i = 0; i < SWEEP_STEPS && Real(0) < entry.distance && t < Real(1); ++i) {
    t = t + entry.distance * inverseWay;
    place = a + t * way;
    entry = nearestOnShape<type>(shape, place, distances);
  }
  const Vec3<Real> back = (place - entry.distance * entry.normal) - b;  // to the entry, on the surface
  const Real lift = dot(back, entry.normal);
  const Real facing = dot(end.normal, entry.normal);
  const Real approach = -dot(way, entry.normal);
  const Real steep = Real(0.25) * wayLength;
  const bool inside = end.distance < Real(0);
  const bool otherSide = !(Real(0.5) < facing) & (Real(0) < approach) & (Real(0) < lift);
  const bool passed = !inside & otherSide & (t < Real(1)) & ((facing < Real(-0.5)) | (steep < approach));

  const Vec3<Real> normal = select(otherSide, entry.normal, end.normal);
  const Real depth = otherSide ? lift : -end.distance;
  const Vec3<Real> out = depth * normal;
  const Vec3<Real> offset = select(passed, back, out);
  const bool touches = inside | passed;
  return {touches, toWorld(shape, offset), toWorld(shape, normal), depth};
}

template <std::uint32_t type, bool mayEnter = true, class Real>
INLINE Contact<Real> findContact(const ColliderParams<Real>& collider, bool coulomb, Real offset,
                                 Vec3<Real> previous, Vec3<Real> x, const float* distances) {
  if constexpr (type == COLLIDER_SPHERE) {
    return sphereContact<mayEnter>(collider, previous, x);
  } else if constexpr (type == COLLIDER_PLANE) {
    return coulomb ? solidPlane(collider, x) : crossedPlane(collider, offset, previous, x);
  } else {
    return shapeContact<type>(collider, previous, x, distances);
  }
}

// What friction takes of the way to the surface. CS184: a share. Coulomb: of the way along the surface,
// friction times the depth that the contact pushed the particle out; it never turns around.
template <class Real>
INLINE Vec3<Real> takenByFriction(const ColliderParams<Real>& collider, bool coulomb,
                                  const Contact<Real>& contact, Vec3<Real> way) {
  if (!coulomb) return collider.friction * way;
  const Vec3<Real> slide = way - dot(way, contact.normal) * contact.normal;
  const Real taken = (collider.friction * contact.depth) * inverseSquareRoot(dot(slide, slide));
  return (taken < Real(1) ? taken : Real(1)) * slide;
}

// Friction may leave a particle a little inside a curved surface, or where it was inside before.
template <std::uint32_t type, class Real>
INLINE Vec3<Real> furtherOut(const ColliderParams<Real>& collider, Vec3<Real> x, const float* distances) {
  if constexpr (type == COLLIDER_SPHERE) {
    const Vec3<Real> d = x - pointOf(collider);
    const Real distanceSquared = dot(d, d);
    const Real inverseDistance = inverseSquareRoot(distanceSquared);
    const Real depth = collider.radius - distanceSquared * inverseDistance;
    const Vec3<Real> normal = inverseDistance * d;
    return select(distanceSquared < collider.radiusSquared, depth * normal, Vec3<Real>{});
  } else if constexpr (type == COLLIDER_PLANE) {
    return {};
  } else {
    const Nearest<Real> nearest = nearestOnShape<type>(collider, toOwnFrame(collider, x), distances);
    const Real depth = nearest.distance < Real(0) ? -nearest.distance : Real(0);
    return toWorld(collider, depth * nearest.normal);
  }
}

// Particles before `done` are left alone.
template <std::uint32_t type, bool mayEnter = true, class Real>
INLINE void collideWith(const PassArguments<Real>& arguments, const ColliderParams<Real>& collider,
                        bool moving, bool coulomb, Range particles, std::ptrdiff_t done = 0) {
  const Components<Real>& old = arguments.before.positions;
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  const Real *x0 = old.x.data(), *y0 = old.y.data(), *z0 = old.z.data();
  Real *x = p.x.data(), *y = p.y.data(), *z = p.z.data(), *vx = v.x.data(), *vy = v.y.data(),
       *vz = v.z.data();
  const Real* inverseMasses = arguments.inverseMasses;
  const Real offset = arguments.step.planeOffset, inverseTimeStep = arguments.step.inverseTimeStep;
  const auto body = [&](std::ptrdiff_t i) __attribute__((always_inline)) {
    const Vec3<Real> now = load(x, y, z, i), start = load(x0, y0, z0, i);
    const Vec3<Real> velocity = load(vx, vy, vz, i);
    const Vec3<Real> rigid = moving ? carried(collider, start) : start;
    const Vec3<Real> previous = deformed<type>(collider, rigid, arguments.distances);
    const Contact<Real> contact =
        findContact<type, mayEnter>(collider, coulomb, offset, previous, now, arguments.distances);
    // Away from a shape with a frame of its own nothing more is worked out.
    if constexpr (type != COLLIDER_SPHERE && type != COLLIDER_PLANE)
      if (!contact.touches) return;
    const Vec3<Real> way = (now - previous) + contact.outward;
    const Vec3<Real> taken = takenByFriction(collider, coulomb, contact, way);
    const Vec3<Real> slid = previous + (way - taken);
    const Vec3<Real> further = furtherOut<type>(collider, slid, arguments.distances);
    const Vec3<Real> corrected = slid + further;
    // Not from the difference of positions, which holds their rounding.
    const Vec3<Real> push = (contact.outward - taken) + further;
    const Vec3<Real> kicked = velocity + inverseTimeStep * push;
    if (!contact.touches || inverseMasses[i] == Real(0) || i < done) return;
    x[i] = canonical(corrected.x);
    y[i] = canonical(corrected.y);
    z[i] = canonical(corrected.z);
    vx[i] = canonical(kicked.x);
    vy[i] = canonical(kicked.y);
    vz[i] = canonical(kicked.z);
  };
  if constexpr (type == COLLIDER_SPHERE || type == COLLIDER_PLANE) {
#pragma omp simd
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) body(i);
  } else {
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) body(i);
  }
}

// What a particle has to do with a sphere or a plane: it touches none without one of these.
constexpr std::uint32_t IS_FAR = 0,
                        IS_INSIDE = 1,  // behind the surface
    MAY_ENTER = 2;                      // on a way long enough to have gone through
template <std::uint32_t type, bool moving, bool coulomb, class Real>
INLINE std::uint32_t nearnessOf(const ColliderParams<Real>& collider, Vec3<Real> start, Vec3<Real> now) {
  using Bits = decltype(bitsOf(Real(0)));
  const Vec3<Real> point = pointOf(collider), previous = moving ? carried(collider, start) : start;
  if constexpr (type == COLLIDER_SPHERE) {
    const Vec3<Real> d = now - point, way = now - previous;
    const bool isInside = bitsOf(dot(d, d)) < bitsOf(collider.radiusSquared);
    const bool mayEnter = bitsOf(dot(way, way)) > bitsOf(collider.sweepSquared);
    return mayEnter ? MAY_ENTER : isInside ? IS_INSIDE : IS_FAR;
  }
  const Vec3<Real> normal{collider.normalX, collider.normalY, collider.normalZ};
  const Bits height = bitsOf(dot(now - point, normal)), before = bitsOf(dot(previous - point, normal));
  return ((coulomb ? height : height ^ before) & bitsOf(Real(-0.0))) != 0 ? IS_INSIDE : IS_FAR;
}

// Spheres and planes. Most particles touch nothing: those of a stretch are looked at first, then sixteen of
// them together. The last sixteen begin among the ones before, which are done.
template <std::uint32_t type, bool moving, bool coulomb, class Real>
INLINE void collideInVectors(const PassArguments<Real>& arguments, const ColliderParams<Real>& collider,
                             Range particles) {
  const Arrays<const Real> x0 = arraysOf(arguments.before.positions),
                           x = arraysOf(std::as_const(arguments.after.positions));
  std::uint32_t near[MESH_ROW], nearest[SIXTEEN]{};  // of every sixteenth
  forEachSixteen(
      particles, [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::ptrdiff_t i = begin; i < end; ++i) {
          const std::uint32_t is = nearnessOf<type, moving, coulomb>(collider, at(x0, i), at(x, i));
          near[i - particles.begin] = is;
          nearest[i - begin] = larger(nearest[i - begin], is);
        }
      });
  if (largestOf(nearest) == IS_FAR) return;
  const std::ptrdiff_t last = std::max(particles.begin, particles.end - SIXTEEN);
  for (std::ptrdiff_t begin = particles.begin; begin < particles.end; begin += SIXTEEN) {
    const std::ptrdiff_t from = std::min(begin, last);
    const Range some{from, std::min(from + SIXTEEN, particles.end)};
    std::uint32_t is = IS_FAR;
    for (std::ptrdiff_t i = some.begin; i < some.end; ++i) is = larger(is, near[i - particles.begin]);
    if (is == MAY_ENTER)
      collideWith<type, true>(arguments, collider, moving, coulomb, some, begin);
    else if (is == IS_INSIDE)
      collideWith<type, false>(arguments, collider, moving, coulomb, some, begin);
  }
}
template <std::uint32_t type, class Real>
INLINE void collideInVectors(const PassArguments<Real>& arguments, const ColliderParams<Real>& of,
                             Range particles) {
  const ColliderParams<Real> collider = of;  // which no store to a particle changes
  const auto collide = [&]<bool moving, bool coulomb>() __attribute__((always_inline)) {
    for (std::ptrdiff_t begin = particles.begin; begin < particles.end; begin += MESH_ROW)
      collideInVectors<type, moving, coulomb>(arguments, collider,
                                              {begin, std::min(begin + MESH_ROW, particles.end)});
  };
  if (collider.moving != 0)
    collider.coulomb != 0 ? collide.template operator()<true, true>()
                          : collide.template operator()<true, false>();
  else
    collider.coulomb != 0 ? collide.template operator()<false, true>()
                          : collide.template operator()<false, false>();
}

// body.operator()<COLLIDER_...>() for the type of the collider.
template <class Real, class Body>
INLINE auto withTypeOf(const ColliderParams<Real>& collider, Body body) {
  switch (collider.type) {
#define CASE(number, Struct, law) \
  case number:                    \
    return body.template operator()<number>();
    CASE(COLLIDER_PLANE, Plane, )
    DISTANCE_SHAPES(CASE)
#undef CASE
  }
  return body.template operator()<COLLIDER_SPHERE>();
}

// Of a shape with a frame of its own: particle by particle.
template <class Real>
[[gnu::noinline]] void collideWithShape(const PassArguments<Real>& arguments,
                                        const ColliderParams<Real>& collider, std::ptrdiff_t i) {
  withTypeOf(collider, [&]<std::uint32_t type>() {
    if constexpr (type != COLLIDER_SPHERE && type != COLLIDER_PLANE)
      collideWith<type>(arguments, collider, collider.moving != 0, collider.coulomb != 0, {i, i + 1});
  });
}

template <class Real>
INLINE void collideRow(const PassArguments<Real>& arguments, int row) {
  const Range particles = rangeOf(arguments.step, row);
  for (std::uint32_t k = 0; k < arguments.step.colliderCount; ++k) {
    const ColliderParams<Real>& collider = arguments.colliders[k];
    if (collider.type == COLLIDER_SPHERE)
      collideInVectors<COLLIDER_SPHERE>(arguments, collider, particles);
    else if (collider.type == COLLIDER_PLANE)
      collideInVectors<COLLIDER_PLANE>(arguments, collider, particles);
    else
      forEachNear(
          collider, arguments.before.positions, arguments.after.positions, particles,
          Real(0), [&](std::ptrdiff_t i) __attribute__((always_inline)) {
            collideWithShape(arguments, collider, i);
          });
  }
  if (arguments.step.colliderCount > 0) watchVelocities(arguments, PASS_COLLIDE, row);
}

// Of a place that touches nothing: how it would if the surface were there.
template <std::uint32_t type, class Real>
INLINE Contact<Real> nearContact(const ColliderParams<Real>& collider, const Contact<Real>& contact,
                                 Vec3<Real> place, const float* distances) {
  if constexpr (type == COLLIDER_SPHERE) {
    return contact;
  } else if constexpr (type == COLLIDER_PLANE) {
    const bool isBelow = collider.coulomb == 0 && contact.depth > Real(0);  // CS184's plane has two sides
    return {false, contact.outward, isBelow ? Real(-1) * contact.normal : contact.normal, contact.depth};
  } else {
    const Nearest<Real> nearest = nearestOnShape<type>(collider, toOwnFrame(collider, place), distances);
    const Vec3<Real> normal = toWorld(collider, nearest.normal);
    return {false, (-nearest.distance) * normal, normal, -nearest.distance};
  }
}

// The contact of what comes from `previous` to `place`; `seeksNear`: also of what touches nothing.
template <class Real>
Contact<Real> contactAt(const PassArguments<Real>& arguments, const ColliderParams<Real>& collider,
                        Vec3<Real> previous, Vec3<Real> place, bool seeksNear) {
  return withTypeOf(collider, [&]<std::uint32_t type>() -> Contact<Real> {
    const Contact<Real> contact = findContact<type>(
        collider, collider.coulomb != 0, arguments.step.planeOffset, previous, place, arguments.distances);
    return contact.touches || !seeksNear ? contact
                                         : nearContact<type>(collider, contact, place, arguments.distances);
  });
}

}  // namespace

template <class Real>
void findPlanes(const PassArguments<Real>& arguments, const Components<Real>& places,
                ContactPlanes<Real>& planes, int row, Real margin) {
  const Range particles = rangeOf(arguments.step, row);
  const bool seeksNear = margin > Real(0);
  for (std::uint32_t k = 0; k < arguments.step.colliderCount; ++k) {
    const ColliderParams<Real>& collider = arguments.colliders[k];
    forEachNear(collider, arguments.before.positions, places, particles, margin, [&](std::ptrdiff_t i) {
      if (arguments.inverseMasses[i] == Real(0)) return;
      const Vec3<Real> known = at(planes.normals, i);
      if (seeksNear && dot(known, known) > Real(0)) return;
      const Vec3<Real> start = at(arguments.before.positions, i), place = at(places, i);
      const Vec3<Real> previous = previousOf(arguments, collider, start);
      const Contact<Real> contact = contactAt(arguments, collider, previous, place, seeksNear);
      const Real distance = contact.depth < Real(0) ? -contact.depth : contact.depth;
      if (!contact.touches && !(seeksNear && distance < margin)) return;
      const bool isFromBelow = contact.touches && contact.depth < Real(0);  // a plane may be met from there
      const Vec3<Real> normal = isFromBelow ? Real(-1) * contact.normal : contact.normal;
      put(planes.normals, i, normal);
      planes.offsets.data()[i] = dot(normal, (place - start) + contact.outward);
      put(planes.carries, i, (previous - start) - at(planes.elasticSlips, i));
      planes.frictions.data()[i] = collider.coulomb != 0 ? collider.friction : Real(0);
    });
  }
}

template <class Real>
Touch<Real> touchAt(const PassArguments<Real>& arguments, std::uint32_t number, Vec3<Real> start,
                    Vec3<Real> place) {
  const ColliderParams<Real>& collider = arguments.colliders[number];
  const Vec3<Real> previous = previousOf(arguments, collider, start);
  const Contact<Real> known = contactAt(arguments, collider, previous, place, true);
  return {known.normal, known.depth, previous - start};
}

template <class Real>
Vec3<Real> placeInFrame(const ColliderParams<Real>& collider, Vec3<Real> x) {
  if (collider.type == COLLIDER_SPHERE) return x - pointOf(collider);
  return toOwnFrame(collider, x);
}
template <class Real>
Vec3<Real> startInFrame(const ColliderParams<Real>& collider, Vec3<Real> x) {
  return placeInFrame(collider, collider.moving != 0 ? carried(collider, x) : x);
}
template <class Real>
Vec3<Real> directionInWorld(const ColliderParams<Real>& collider, Vec3<Real> direction) {
  return toWorld(collider, direction);
}

#define INSTANTIATE(Real)                                                                          \
  template Touch<Real> touchAt(const PassArguments<Real>&, std::uint32_t, Vec3<Real>, Vec3<Real>); \
  template Vec3<Real> directionInWorld(const ColliderParams<Real>&, Vec3<Real>);                   \
  template Vec3<Real> placeInFrame(const ColliderParams<Real>&, Vec3<Real>);                       \
  template Vec3<Real> startInFrame(const ColliderParams<Real>&, Vec3<Real>);
INSTANTIATE(float)
INSTANTIATE(double)
#undef INSTANTIATE

template void findPlanes(const PassArguments<float>&, const Components<float>&, ContactPlanes<float>&, int,
                         float);
template void findPlanes(const PassArguments<double>&, const Components<double>&, ContactPlanes<double>&, int,
                         double);

VECTOR_CLONES(void, collide, (const PassArguments<float>& arguments, int row), (arguments, row),
              collideRow(arguments, row))
void collide(const PassArguments<double>& arguments, int row) { collideRow(arguments, row); }

}  // namespace clothsim::cpu
