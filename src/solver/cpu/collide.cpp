#include "solver/cpu/collide.h"

#include <algorithm>
#include <utility>

#include "solver/cpu/arrays.h"
#include "solver/cpu/collider_contacts.h"
#include "solver/cpu/collider_frames.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {
namespace {

// What friction takes of the way to the surface. CS184: a share. Coulomb: of the way along the surface,
// friction times the depth that the contact pushed the particle out; it never turns around.
template <bool coulomb, class Real>
INLINE Vec3<Real> takenByFriction(const ColliderParams<Real>& collider, const Contact<Real>& contact,
                                  Vec3<Real> way) {
  if constexpr (!coulomb) return collider.friction * way;
  const Vec3<Real> slide = way - dot(way, contact.normal) * contact.normal;
  const Real taken = (collider.friction * contact.depth) * inverseSquareRoot(dot(slide, slide));
  return (taken < Real(1) ? taken : Real(1)) * slide;
}

// What contacts move.
template <class Real>
struct Moved {
  Arrays<Real> x, v;
  Real inverseTimeStep;
};
template <class Real>
INLINE Moved<Real> movedBy(const PassArguments<Real>& arguments) {
  return {arraysOf(arguments.after.positions), arraysOf(arguments.after.velocities),
          arguments.step.inverseTimeStep};
}

// What a particle that moved to x, and its velocity, go by.
template <class Real>
struct Move {
  Vec3<Real> slid, push;
};
template <bool coulomb, class Real>
INLINE Move<Real> moveOf(const ColliderParams<Real>& collider, Vec3<Real> previous, Vec3<Real> now,
                         const Contact<Real>& contact) {
  const Vec3<Real> way = (now - previous) + contact.outward;
  const Vec3<Real> taken = takenByFriction<coulomb>(collider, contact, way);
  // Not from the difference of positions, which holds their rounding.
  return {previous + (way - taken), contact.outward - taken};
}
// Particle i goes so, and `further` out, if it `acts`: friction may leave it a little inside a curved
// surface, or where it was inside before.
template <class Real>
INLINE void move(const Moved<Real>& moved, std::ptrdiff_t i, const Move<Real>& by, Vec3<Real> further,
                 std::uint32_t acts) {
  const Vec3<Real> now = at(moved.x, i), velocity = at(moved.v, i);
  const Vec3<Real> corrected = by.slid + further, push = by.push + further;
  const Vec3<Real> kicked = velocity + moved.inverseTimeStep * push;
  put(moved.x, i, chosen(acts, canonical(corrected), now));
  put(moved.v, i, chosen(acts, canonical(kicked), velocity));
}

// Of a sphere or a plane.
template <std::uint32_t type, bool mayEnter, bool coulomb, class Real>
INLINE Contact<Real> contactWith(const ColliderParams<Real>& collider, Real offset, Vec3<Real> previous,
                                 Vec3<Real> now) {
  if constexpr (type == COLLIDER_SPHERE)
    return sphereContact<mayEnter>(collider, previous, now);
  else if constexpr (coulomb)
    return solidPlane(collider, now);
  else
    return crossedPlane(collider, offset, previous, now);
}
template <std::uint32_t type, class Real>
INLINE Vec3<Real> furtherOut(const ColliderParams<Real>& collider, Vec3<Real> x) {
  if constexpr (type == COLLIDER_PLANE) return {};
  const Vec3<Real> d = x - pointOf(collider);
  const Real distanceSquared = dot(d, d);
  const Real inverseDistance = inverseSquareRoot(distanceSquared);
  const Real depth = collider.radius - distanceSquared * inverseDistance;
  const Vec3<Real> normal = inverseDistance * d;
  return selected(distanceSquared < collider.radiusSquared, depth * normal, Vec3<Real>{});
}

// Of particles side by side from `first`, those before `done` are left alone.
template <int lanes, std::uint32_t type, bool mayEnter, bool moving, bool coulomb, class Real>
INLINE void collideWith(const PassArguments<Real>& arguments, const ColliderParams<Real>& collider,
                        std::ptrdiff_t first, std::ptrdiff_t done) {
  const Arrays<const Real> starts = countedFrom(first, arraysOf(arguments.before.positions));
  const Moved<Real> all = movedBy(arguments),
                    moved{countedFrom(first, all.x), countedFrom(first, all.v), all.inverseTimeStep};
  const Real* inverseMasses = arguments.inverseMasses + first;
  const Real offset = arguments.step.planeOffset;
  const int toDo = static_cast<int>(done - first);
#pragma GCC ivdep
  for (int i = 0; i < lanes; ++i) {
    const Vec3<Real> now = at(moved.x, i);
    Vec3<Real> previous = at(starts, i);
    if constexpr (moving) previous = carried(collider, previous);
    const Contact<Real> contact = contactWith<type, mayEnter, coulomb>(collider, offset, previous, now);
    const Move<Real> by = moveOf<coulomb>(collider, previous, now, contact);
    const std::uint32_t isFree = inverseMasses[i] != Real(0) ? 1 : 0, isToDo = i >= toDo ? 1 : 0;
    move(moved, i, by, furtherOut<type>(collider, by.slid), (contact.touches ? 1u : 0u) & isFree & isToDo);
  }
}

// What a particle has to do with a sphere or a plane: it touches none without one of these.
constexpr std::uint32_t IS_FAR = 0,
                        IS_INSIDE = 1,  // behind the surface
    MAY_ENTER = 2;                      // on a way long enough to have gone through
// A plane has no inside to enter.
template <std::uint32_t type>
constexpr bool hasInside = type == COLLIDER_SPHERE;
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
  const std::ptrdiff_t last = particles.end - SIXTEEN;
  if (last < particles.begin) {
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i)
      collideWith<1, type, hasInside<type>, moving, coulomb>(arguments, collider, i, i);
    return;
  }
  for (std::ptrdiff_t begin = particles.begin; begin < particles.end; begin += SIXTEEN) {
    const std::ptrdiff_t first = std::min(begin, last);
    std::uint32_t is = IS_FAR;
    for (std::ptrdiff_t i = 0; i < SIXTEEN; ++i) is = larger(is, near[first - particles.begin + i]);
    if (is == MAY_ENTER)
      collideWith<SIXTEEN, type, hasInside<type>, moving, coulomb>(arguments, collider, first, begin);
    else if (is == IS_INSIDE)
      collideWith<SIXTEEN, type, false, moving, coulomb>(arguments, collider, first, begin);
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

// The ways of particles to `places`; where they are fewer than sixteen, the last is there again.
template <class Real>
INLINE void setWays(const PassArguments<Real>& arguments, const ColliderParams<Real>& collider,
                    const Arrays<const Real>& places, Range particles, Ways<Real>& ways) {
  const Arrays<const Real> starts = arraysOf(arguments.before.positions);
  const std::ptrdiff_t last = particles.end - 1;
  const auto set = [&](auto particleAt) __attribute__((always_inline)) {
    setWays<SIXTEEN>(
        collider, arguments.distances, ways,
        [&](std::ptrdiff_t lane) __attribute__((always_inline)) { return at(starts, particleAt(lane)); },
        [&](std::ptrdiff_t lane) __attribute__((always_inline)) { return at(places, particleAt(lane)); });
  };
  if (particles.end - particles.begin == SIXTEEN)
    set([&](std::ptrdiff_t lane) __attribute__((always_inline)) { return particles.begin + lane; });
  else
    set([&](std::ptrdiff_t lane)
            __attribute__((always_inline)) { return std::min(particles.begin + lane, last); });
}

// Of a shape with a frame of its own.
template <class Real>
INLINE void collideWithShape(const PassArguments<Real>& arguments, const ColliderParams<Real>& of,
                             Range particles) {
  const ColliderParams<Real> collider = of;  // which no store to a particle changes
  Ways<Real> ways;
  Contacts<Real> contacts;
  setWays(arguments, collider, arraysOf(std::as_const(arguments.after.positions)), particles, ways);
  findShapeContacts<SIXTEEN>(collider, ways, arguments.distances, contacts);
  if (largestOf(contacts.touch) == 0) return;
  Lanes<Real> slid, pushes, slidInFrame;
  const auto slide = [&]<bool coulomb>() __attribute__((always_inline)) {
#pragma GCC ivdep
    for (std::ptrdiff_t lane = 0; lane < SIXTEEN; ++lane) {
      const Move<Real> by =
          moveOf<coulomb>(collider, at(ways.previous, lane), at(ways.places, lane), contacts.at(lane));
      put(slid, lane, by.slid);
      put(pushes, lane, by.push);
      put(slidInFrame, lane, toOwnFrame(collider, by.slid));
    }
  };
  collider.coulomb != 0 ? slide.template operator()<true>() : slide.template operator()<false>();
  NearestPlaces<Real> nearest;
  findNearest(collider, SIXTEEN, slidInFrame, arguments.distances, nearest);
  const Moved<Real> moved = movedBy(arguments);
  const Real* inverseMasses = arguments.inverseMasses;
  forEachSixteen(
      particles, [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
        std::uint32_t acts[SIXTEEN];
#pragma GCC ivdep
        for (std::ptrdiff_t i = begin; i < end; ++i)
          acts[i - begin] = inverseMasses[i] != Real(0) ? contacts.touch[i - begin] : 0;
#pragma GCC ivdep
        for (std::ptrdiff_t i = begin; i < end; ++i) {
          const std::ptrdiff_t lane = i - begin;
          const Real distance = nearest.distances[lane], depth = distance < Real(0) ? -distance : Real(0);
          move(moved, i, {at(slid, lane), at(pushes, lane)},
               toWorld(collider, depth * at(nearest.normals, lane)), acts[lane]);
        }
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
          Real(0), [&](Range some) __attribute__((always_inline)) {
            collideWithShape(arguments, collider, some);
          });
  }
  if (arguments.step.colliderCount > 0) watchVelocities(arguments, PASS_COLLIDE, row);
}

// The planes of some particles at one collider.
template <class Real>
INLINE void putPlanes(const PassArguments<Real>& arguments, const ColliderParams<Real>& collider,
                      const Components<Real>& places, ContactPlanes<Real>& planes, Range particles,
                      Real margin) {
  const bool seeksNear = margin > Real(0);
  Ways<Real> ways;
  Contacts<Real> contacts;
  setWays(arguments, collider, arraysOf(places), particles, ways);
  findContacts<SIXTEEN>(collider, arguments.step.planeOffset, ways, arguments.distances, contacts);
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const std::ptrdiff_t lane = i - particles.begin;
    const Contact<Real> contact = contacts.at(lane);
    const Real distance = contact.depth < Real(0) ? -contact.depth : contact.depth;
    if (!contact.touches && !(seeksNear && distance < margin)) continue;
    if (arguments.inverseMasses[i] == Real(0)) continue;
    const Vec3<Real> known = at(planes.normals, i);
    if (seeksNear && dot(known, known) > Real(0)) continue;
    const Vec3<Real> start = at(arguments.before.positions, i);
    const bool isFromBelow = contact.touches && contact.depth < Real(0);  // a plane may be met from there
    const Vec3<Real> normal = isFromBelow ? Real(-1) * contact.normal : contact.normal;
    put(planes.normals, i, normal);
    planes.offsets.data()[i] = dot(normal, (at(places, i) - start) + contact.outward);
    put(planes.carries, i, (at(ways.previous, lane) - start) - at(planes.elasticSlips, i));
    planes.frictions.data()[i] = collider.coulomb != 0 ? collider.friction : Real(0);
  }
}

template <class Real>
INLINE void findPlanesOfRow(const PassArguments<Real>& arguments, const Components<Real>& places,
                            ContactPlanes<Real>& planes, int row, Real margin) {
  for (std::uint32_t k = 0; k < arguments.step.colliderCount; ++k) {
    const ColliderParams<Real>& collider = arguments.colliders[k];
    forEachNear(
        collider, arguments.before.positions, places, rangeOf(arguments.step, row),
        margin, [&](Range some) __attribute__((always_inline)) {
          putPlanes(arguments, collider, places, planes, some, margin);
        });
  }
}

}  // namespace

VECTOR_CLONES(void, findPlanes,
              (const PassArguments<float>& arguments, const Components<float>& places,
               ContactPlanes<float>& planes, int row, float margin),
              (arguments, places, planes, row, margin),
              findPlanesOfRow(arguments, places, planes, row, margin))
void findPlanes(const PassArguments<double>& arguments, const Components<double>& places,
                ContactPlanes<double>& planes, int row, double margin) {
  findPlanesOfRow(arguments, places, planes, row, margin);
}

template <class Real>
Touch<Real> touchAt(const PassArguments<Real>& arguments, std::uint32_t number, Vec3<Real> start,
                    Vec3<Real> place) {
  const ColliderParams<Real>& collider = arguments.colliders[number];
  Ways<Real> ways;
  Contacts<Real> contacts;
  setWays<1>(
      collider, arguments.distances, ways, [&](std::ptrdiff_t) { return start; },
      [&](std::ptrdiff_t) { return place; });
  findContacts<1>(collider, arguments.step.planeOffset, ways, arguments.distances, contacts);
  const Contact<Real> contact = contacts.at(0);
  return {contact.normal, contact.depth, at(ways.previous, 0) - start};
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

VECTOR_CLONES(void, collide, (const PassArguments<float>& arguments, int row), (arguments, row),
              collideRow(arguments, row))
void collide(const PassArguments<double>& arguments, int row) { collideRow(arguments, row); }

}  // namespace clothsim::cpu
