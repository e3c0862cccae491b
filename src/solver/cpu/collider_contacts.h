// What colliders do to what moves: contacts of sixteen ways at a time, or of one. The twin of what
// shaders/sim/collide.glsl says of them.
#pragma once

#include <bit>
#include <cstdint>

#include "solver/cpu/arrays.h"
#include "solver/cpu/collider_frames.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/shapes.h"
#include "solver/cpu/vectors.h"

namespace clothsim::cpu {

// The first where `which` is 1, the second where it is 0, by their bits: a loop that chooses by ?: between
// elements of arrays is not vectorized.
template <class Real>
INLINE Real chosen(std::uint32_t which, Real first, Real second) {
  using Bits = decltype(bitsOf(Real(0)));
  const Bits mask = -static_cast<Bits>(which);
  return std::bit_cast<Real>(static_cast<Bits>((bitsOf(first) & mask) | (bitsOf(second) & ~mask)));
}
template <class Real>
INLINE Vec3<Real> chosen(std::uint32_t which, Vec3<Real> first, Vec3<Real> second) {
  return {chosen(which, first.x, second.x), chosen(which, first.y, second.y),
          chosen(which, first.z, second.z)};
}

template <class Real>
struct Contact {
  bool touches;
  Vec3<Real> outward;  // to the surface, where the particle goes without friction
  Vec3<Real> normal;   // of the collider there, outward
  Real depth;          // how far that is along the normal [m]
};

// The contacts of up to sixteen. What touches nothing has what it would have if it touched the surface where
// that is nearest.
template <class Real>
struct Contacts {
  Lanes<Real> outward, normals;
  alignas(64) Real depths[SIXTEEN];
  alignas(64) std::uint32_t touch[SIXTEEN]{};  // 1, or 0

  INLINE void set(std::ptrdiff_t lane, const Contact<Real>& contact) {
    put(outward, lane, contact.outward);
    put(normals, lane, contact.normal);
    depths[lane] = contact.depth;
    touch[lane] = contact.touches ? 1 : 0;
  }
  [[nodiscard]] INLINE Contact<Real> at(std::ptrdiff_t lane) const {
    return {touch[lane] != 0, cpu::at(outward, lane), cpu::at(normals, lane), depths[lane]};
  }
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

  const Vec3<Real> normal = selected(entered, entryNormal, inverseDistance * d);
  const Real depth = entered ? sphere.radius - facing : sphere.radius - distance;
  const Vec3<Real> outward = selected(entered, toEntry, depth * normal);
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

// The nearest places of a shape, seen from points in its own frame.
template <class Real>
struct NearestPlaces {
  alignas(64) Real distances[SIXTEEN];
  Lanes<Real> normals;
};
// Of sixteen points, or of the first one alone. `distances` are the samples of meshes.
void findNearest(const ColliderParams<float>& shape, std::ptrdiff_t count, const Lanes<float>& points,
                 const float* distances, NearestPlaces<float>& nearest);
void findNearest(const ColliderParams<double>& shape, std::ptrdiff_t count, const Lanes<double>& points,
                 const float* distances, NearestPlaces<double>& nearest);
// Where the surface of a body that deforms takes in the step what was at these points, in the world, at its
// start: in place.
void deform(const ColliderParams<float>& body, std::ptrdiff_t count, Lanes<float>& points,
            const float* distances);
void deform(const ColliderParams<double>& body, std::ptrdiff_t count, Lanes<double>& points,
            const float* distances);

// The ways of sixteen particles, or of one: from where they were at the start of the step, carried along with
// the collider, to where they are.
template <class Real>
struct Ways {
  Lanes<Real> previous, places;
};
// Of those that are at startAt(lane) and placeAt(lane).
template <std::ptrdiff_t count, class Real, class StartAt, class PlaceAt>
INLINE void setWays(const ColliderParams<Real>& of, const float* distances, Ways<Real>& ways, StartAt startAt,
                    PlaceAt placeAt) {
  const ColliderParams<Real> collider = of;  // which no store changes
  const bool moving = collider.moving != 0;
#pragma GCC ivdep
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    const Vec3<Real> start = startAt(lane), moved = carried(collider, start);
    put(ways.previous, lane, selected(moving, moved, start));
    put(ways.places, lane, placeAt(lane));
  }
  if (collider.type == COLLIDER_MESH && collider.way != 0) deform(collider, count, ways.previous, distances);
}

// Where ways enter a shape.
template <class Real>
struct Entries {
  Lanes<Real> places;  // in the frame of the shape
  NearestPlaces<Real> nearest;
  Real parts[SIXTEEN], inverseWays[SIXTEEN];  // how much of the way that is; 1 / the length of the way
};
// Of ways from `starts` to `ends` in the frame of the shape that may touch it. Sphere tracing (Hart, 1996):
// going on by the distance never oversteps the surface. From inside, the entry is taken to be the nearest
// point of the surface.
template <std::ptrdiff_t count, class Real>
INLINE void findEntries(const ColliderParams<Real>& shape, const Lanes<Real>& starts, const Lanes<Real>& ends,
                        const std::uint32_t (&mayTouch)[SIXTEEN], const float* distances,
                        Entries<Real>& entries) {
  NearestPlaces<Real>& nearest = entries.nearest;
  findNearest(shape, count, starts, distances, nearest);
  entries.places = starts;
  std::uint32_t goesOn[SIXTEEN]{};
#pragma GCC ivdep
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    const Vec3<Real> way = at(ends, lane) - at(starts, lane);
    entries.inverseWays[lane] = inverseSquareRoot(dot(way, way));
    entries.parts[lane] = Real(0);
    goesOn[lane] = Real(0) < nearest.distances[lane] ? mayTouch[lane] : 0;
  }
  for (int i = 0; i < SWEEP_STEPS && largestOf(goesOn) != 0; ++i) {
    Lanes<Real> next;
    Real nextParts[SIXTEEN];
#pragma GCC ivdep
    for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
      const Vec3<Real> way = at(ends, lane) - at(starts, lane);
      nextParts[lane] = entries.parts[lane] + nearest.distances[lane] * entries.inverseWays[lane];
      put(next, lane, at(starts, lane) + nextParts[lane] * way);
    }
    NearestPlaces<Real> there;
    findNearest(shape, count, next, distances, there);
#pragma GCC ivdep
    for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
      const std::uint32_t goes = goesOn[lane];
      entries.parts[lane] = chosen(goes, nextParts[lane], entries.parts[lane]);
      nearest.distances[lane] = chosen(goes, there.distances[lane], nearest.distances[lane]);
      put(entries.places, lane, chosen(goes, at(next, lane), at(entries.places, lane)));
      put(nearest.normals, lane, chosen(goes, at(there.normals, lane), at(nearest.normals, lane)));
    }
#pragma GCC ivdep
    for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
      const std::uint32_t isOutside = Real(0) < nearest.distances[lane] ? 1 : 0,
                          isOnWay = entries.parts[lane] < Real(1) ? 1 : 0;
      goesOn[lane] = goesOn[lane] & isOutside & isOnWay;
    }
  }
}

// A shape known by its signed distance. A particle inside goes to the nearest point of the surface, provided
// that this is on the side where it came in: the normals there and at the entry are less than 60 degrees
// apart. Otherwise it goes back to the tangent plane at the entry. A particle that is outside on another
// side, having gone through, goes to the entry itself; grazing ways around an edge do not count as going
// through.
template <std::ptrdiff_t count, class Real>
INLINE void findShapeContacts(const ColliderParams<Real>& of, const Ways<Real>& ways, const float* distances,
                              Contacts<Real>& contacts) {
  const ColliderParams<Real> shape = of;  // which no store changes
  Lanes<Real> starts, ends;               // in the frame of the shape
  NearestPlaces<Real> end;
  Entries<Real> found;
#pragma GCC ivdep
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    put(starts, lane, toOwnFrame(shape, at(ways.previous, lane)));
    put(ends, lane, toOwnFrame(shape, at(ways.places, lane)));
  }
  findNearest(shape, count, ends, distances, end);
  std::uint32_t mayTouch[SIXTEEN]{};
#pragma GCC ivdep
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    const Real distance = end.distances[lane], distanceSquared = distance * distance;
    const Vec3<Real> moved = at(ways.places, lane) - at(ways.previous, lane);
    // No place of the way is nearer than the distance at its end less its length.
    const bool isFar = (Real(0) < distance) & (dot(moved, moved) < distanceSquared);
    const Vec3<Real> normal = toWorld(shape, at(end.normals, lane));
    contacts.set(lane, {false, (-distance) * normal, normal, -distance});
    mayTouch[lane] = isFar ? 0 : 1;
  }
  if (largestOf(mayTouch) == 0) return;

  findEntries<count>(shape, starts, ends, mayTouch, distances, found);
  // Flags are set in a loop of their own: one that sets them and acts by them is not vectorized.
  Lanes<Real> backs;  // to the entries, on the surface
  Real lifts[SIXTEEN];
  std::uint32_t isOnOtherSide[SIXTEEN], hasPassed[SIXTEEN];
#pragma GCC ivdep
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    const Vec3<Real> way = at(ends, lane) - at(starts, lane), entryNormal = at(found.nearest.normals, lane);
    const Vec3<Real> back =
        (at(found.places, lane) - found.nearest.distances[lane] * entryNormal) - at(ends, lane);
    const Real lift = dot(back, entryNormal);
    const Real facing = dot(at(end.normals, lane), entryNormal);
    const Real approach = -dot(way, entryNormal);
    const Real steep = Real(0.25) * (dot(way, way) * found.inverseWays[lane]);
    const bool otherSide = !(Real(0.5) < facing) & (Real(0) < approach) & (Real(0) < lift);
    const bool entered = (found.parts[lane] < Real(1)) & ((facing < Real(-0.5)) | (steep < approach));
    const std::uint32_t isOutside = end.distances[lane] < Real(0) ? 0 : 1;
    put(backs, lane, back);
    lifts[lane] = lift;
    isOnOtherSide[lane] = otherSide ? 1 : 0;
    hasPassed[lane] = (entered ? 1 : 0) & isOnOtherSide[lane] & isOutside;
    contacts.touch[lane] = ((1 - isOutside) | hasPassed[lane]) & mayTouch[lane];
  }
#pragma GCC ivdep
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    const std::uint32_t otherSide = isOnOtherSide[lane], touches = contacts.touch[lane];
    const Vec3<Real> normal = chosen(otherSide, at(found.nearest.normals, lane), at(end.normals, lane));
    const Real depth = chosen(otherSide, lifts[lane], -end.distances[lane]);
    const Vec3<Real> offset = chosen(hasPassed[lane], at(backs, lane), depth * normal);
    put(contacts.outward, lane, chosen(touches, toWorld(shape, offset), at(contacts.outward, lane)));
    put(contacts.normals, lane, chosen(touches, toWorld(shape, normal), at(contacts.normals, lane)));
    contacts.depths[lane] = chosen(touches, depth, contacts.depths[lane]);
  }
}

// `offset`: StepParams::planeOffset.
template <std::ptrdiff_t count, class Real>
INLINE void findContacts(const ColliderParams<Real>& of, Real offset, const Ways<Real>& ways,
                         const float* distances, Contacts<Real>& contacts) {
  const ColliderParams<Real> collider = of;  // which no store changes
  const auto setEach = [&](auto contactOf) __attribute__((always_inline)) {
#pragma GCC ivdep
    for (std::ptrdiff_t lane = 0; lane < count; ++lane)
      contacts.set(lane, contactOf(at(ways.previous, lane), at(ways.places, lane)));
  };
  if (collider.type == COLLIDER_SPHERE)
    setEach([&](Vec3<Real> from, Vec3<Real> place)
                __attribute__((always_inline)) { return sphereContact<true>(collider, from, place); });
  else if (collider.type == COLLIDER_PLANE && collider.coulomb != 0)
    setEach([&](Vec3<Real>, Vec3<Real> place)
                __attribute__((always_inline)) { return solidPlane(collider, place); });
  else if (collider.type == COLLIDER_PLANE)  // CS184's has two sides
    setEach([&](Vec3<Real> from, Vec3<Real> place) __attribute__((always_inline)) {
      Contact<Real> contact = crossedPlane(collider, offset, from, place);
      const Real side = contact.depth > Real(0) ? Real(-1) : Real(1);
      const Real kept = contact.touches ? Real(1) : side;
      contact.normal = kept * contact.normal;
      return contact;
    });
  else
    findShapeContacts<count>(collider, ways, distances, contacts);
}

}  // namespace clothsim::cpu
