#include "solver/cpu/small_colliders.h"

#include <atomic>

#include "core/thread_team.h"
#include "shared/shapes.h"
#include "solver/cpu/implicit_contact.h"
#include "solver/cpu/shapes.h"
#include "solver/cpu/surface_search.h"
#include "solver/hierarchy.h"

namespace clothsim::cpu {

#include "solver/cpu/begin_laws.h"

// What the laws in shaders/shared/deepest_place.h are written in, as C++.
template <class Real>
struct MeetingLaws : SurfaceLaws<Real> {
  using Base = SurfaceLaws<Real>;
  using typename Base::Meeting;
  using typename Base::NearestParts;
  using typename Base::real;
  using typename Base::SmallCollider;
  using typename Base::uint;
  using typename Base::vec3;
  using ColliderParams = const shared::ColliderParams<Real>&;
  using Base::canonical;
  using Base::crossProduct;
  using Base::inverseSquareRoot;
  using Base::isAboveTriangle;
  using Base::meetingAt;
  using Base::meetingOf;
  using Base::nearestOnCore;
  using Base::nearestOnTriangle;
  using Base::nearestToCore;
  using Base::partOf;
  using Base::sumOfProducts;

  const float* distances;  // samples of the meshes

  explicit MeetingLaws(const float* samples) : distances(samples) {}
  Nearest<Real> nearestOnShape(ColliderParams shape, vec3 p) const {
    return cpu::nearestOnShape(shape, p, distances);
  }

#include "shared/deepest_place.h"
};

#include "solver/cpu/end_laws.h"

namespace {

constexpr std::uint32_t COLLIDER_PAIRS_AT_ONCE = 16;

template <class Real>
Vec3<Real> lowest(Vec3<Real> a, Vec3<Real> b) {
  return {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z};
}
template <class Real>
Vec3<Real> highest(Vec3<Real> a, Vec3<Real> b) {
  return {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
}

// Around the way of a triangle.
template <class Real>
struct WayBox {
  Vec3<Real> low, high;
  void add(Vec3<Real> x) {
    low = lowest(low, x);
    high = highest(high, x);
  }
  [[nodiscard]] bool isNear(Vec3<Real> size, Real near) const {  // to a box around the center
    return low.x - near <= size.x && -size.x <= high.x + near && low.y - near <= size.y &&
           -size.y <= high.y + near && low.z - near <= size.z && -size.z <= high.z + near;
  }
};

template <class Real>
std::uint32_t numberOf(const SmallCollider<Real>& small) {
  return static_cast<std::uint32_t>(small.number);
}

// A round collider is where its core is nearest; others have an edge, or may have.
inline bool isRound(std::uint32_t type) { return type == COLLIDER_SPHERE || type == COLLIDER_CAPSULE; }

template <class Real>
Vec3<Real> coreSize(const SmallCollider<Real>& small) {
  const bool around = Real(0) < small.outerRadius;
  return {around ? small.outerRadius : small.coreX, small.coreY, around ? small.outerRadius : small.coreZ};
}
// How far from its surface is near.
template <class Real>
Real reachOf(const SmallCollider<Real>& small) {
  return small.near - small.radius;
}

// Whether a triangle comes to where the surface turns within it. On flat parts particles are enough.
template <class Real>
bool meetsEdge(const ColliderParams<Real>& collider, const Vec3<Real> (&places)[6],
               const SmallCollider<Real>& small, const float* distances) {
  Nearest<Real> nearest[6];
  bool isNear = false, turns = false;
  for (std::size_t k = 0; k < 6; ++k) {
    nearest[k] = nearestOnShape(collider, places[k], distances);
    const Vec3<Real> way = places[k % 3 + 3] - places[k % 3];
    const Real room = nearest[k].distance - reachOf(small);
    isNear = isNear || room < Real(0) || room * room < dot(way, way);
    for (std::size_t j = 0; j < k; ++j)
      turns = turns || dot(nearest[j].normal, nearest[k].normal) < Real(SAME_FACE);
  }
  return isNear && turns;
}

// Where a triangle meets a collider, as a point of the cloth. `keeps`: as in shared/deepest_place.h.
template <class Real>
struct Met {
  std::array<Real, 4> weights;
  Touch<Real> touch;
  bool counts;  // particles do not see it alone, and it is not far
  bool passes;
};

template <class Real>
Met<Real> meet(const PassArguments<Real>& arguments, const SmallCollider<Real>& small,
               const SurfacePair<Real>& pair, const Components<Real>& ends, bool keeps = false) {
  const std::array<std::uint32_t, 4>& particles = pair.particles;
  const std::uint32_t number = numberOf(small);
  const ColliderParams<Real>& collider = arguments.colliders[number];
  const Components<Real>& starts = arguments.before.positions;
  Vec3<Real> from[3], to[3], start[3], end[3];
  for (std::size_t k = 0; k < 3; ++k) {
    start[k] = at(starts, particles[k]);
    end[k] = at(ends, particles[k]);
    from[k] = startInFrame(collider, start[k]);
    to[k] = placeInFrame(collider, end[k]);
  }
  MeetingLaws<Real> laws(arguments.distances);
  const bool round = isRound(collider.type);
  const auto meeting =
      round ? SurfaceLaws<Real>::meetingOf(small, from, to)
            : laws.meetingWithShape(collider, small, from, to, keeps, pair.weights[1], pair.weights[2]);
  Met<Real> met{};
  const Real rest = (Real(1) - meeting.u) - meeting.v;
  met.weights = {canonical(rest), canonical(meeting.u), canonical(meeting.v), Real(0)};
  const auto weigh = [&](const Vec3<Real>(&x)[3]) {
    return (met.weights[0] * x[0] + met.weights[1] * x[1]) + met.weights[2] * x[2];
  };
  met.touch = touchAt(arguments, number, weigh(start), weigh(end));
  if (!round)
    if (const auto way = laws.wayOutOf(collider, small, from, to, meeting); way.counts) {
      met.touch.normal = directionInWorld(collider, way.normal);
      met.touch.depth = way.depth;
    }
  const bool isCorner = meeting.part != NEAREST_FACE && meeting.part < NEAREST_SIDE;
  met.counts = (meeting.passes || !isCorner) && -small.radius < met.touch.depth;
  met.passes = meeting.passes;
  return met;
}

template <class Real, class Visit>
void forEachColliderPair(const TouchingPairs<Real>& touching, Visit visit) {
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(touching.pairs.size()), COLLIDER_PAIRS_AT_ONCE,
                               [&](std::uint32_t q) {
                                 if (touching.pairs[q].collider != NO_COLLIDER) visit(q);
                               });
}

}  // namespace

template <class Real>
void addNearColliders(const ClothSurface<Real>& surface, const PassArguments<Real>& arguments,
                      const ImplicitState<Real>& implicit, const SurfaceTriangle& triangle,
                      std::vector<SurfacePair<Real>>& found) {
  const std::uint32_t corners[3] = {triangle.cornerA, triangle.cornerB, triangle.cornerC};
  Vec3<Real> x[6];
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = at(arguments.before.positions, corners[k]);
    x[3 + k] = x[k] + at(implicit.displacements, corners[k]);
  }
  WayBox<Real> world{x[0], x[0]};
  for (const Vec3<Real>& place : x) world.add(place);
  for (std::uint32_t s = 0; s < surface.colliders.size(); ++s) {
    const SmallCollider<Real>& small = surface.colliders[s];
    const ColliderParams<Real>& collider = arguments.colliders[numberOf(small)];
    const Vec3<Real> end{collider.pointX, collider.pointY, collider.pointZ},
        begin = collider.moving != 0 ? Vec3<Real>{collider.pivotX, collider.pivotY, collider.pivotZ} : end;
    const Vec3<Real> low = lowest(begin, end), high = highest(begin, end);
    const Real bound = small.bound;
    if (!(world.low.x - bound <= high.x && low.x <= world.high.x + bound && world.low.y - bound <= high.y &&
          low.y <= world.high.y + bound && world.low.z - bound <= high.z && low.z <= world.high.z + bound))
      continue;
    if (collider.type != COLLIDER_SPHERE) {
      Vec3<Real> places[6];
      for (std::size_t k = 0; k < 3; ++k) places[k] = startInFrame(collider, x[k]);
      for (std::size_t k = 3; k < 6; ++k) places[k] = placeInFrame(collider, x[k]);
      WayBox<Real> own{places[0], places[0]};
      for (const Vec3<Real>& place : places) own.add(place);
      if (!own.isNear(coreSize(small), small.near)) continue;
      if (!isRound(collider.type) && !meetsEdge(collider, places, small, arguments.distances)) continue;
    }
    SurfacePair<Real> pair{};
    pair.particles = {corners[0], corners[1], corners[2], corners[0]};
    pair.collider = s;
    pair.limit = static_cast<Real>(LARGE_SQUARE);  // not known
    found.push_back(pair);
  }
}

template <class Real>
void meetColliders(const ClothSurface<Real>& surface, const PassArguments<Real>& arguments,
                   ImplicitState<Real>& implicit) {
  TouchingPairs<Real>& touching = implicit.touching;
  forEachColliderPair(touching, [&](std::uint32_t q) {
    SurfacePair<Real>& pair = touching.pairs[q];
    const SmallCollider<Real>& small = surface.colliders[pair.collider];
    const ColliderParams<Real>& collider = arguments.colliders[numberOf(small)];
    // What still presses as it was is held as it is now: that it has slid a hair off decides nothing.
    const Real before = pair.over - dot(pair.normal, weighted(pair, implicit.displacements));
    const bool pressed = pair.held > Real(0) && before > Real(0);
    const bool isNew = !(pair.limit < static_cast<Real>(LARGE_SQUARE));
    const bool follows = isNew || frictionFollows(implicit);
    const Met<Real> met = meet(arguments, small, pair, implicit.iterate.positions, !follows);
    pair.weights = met.weights;
    Real inertia = 0, springs = 0, squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Real w = pair.weights[k], square = w * w;
      inertia = inertia + square * implicit.diagonal[pair.particles[k]];
      springs = springs + square * surface.points[pair.particles[k]].stiffness;
      squares = squares + square;
    }
    const Real inverse = reciprocal(squares), ofInertia = inertia * inverse,
               most = static_cast<Real>(MOST_OVER_INERTIA) * ofInertia, ofSprings = springs * inverse,
               stiffness = Real(CONTACT_OVER_INERTIA) * ofInertia + (ofSprings < most ? ofSprings : most);
    const Real depth = met.touch.depth;
    const bool holds = met.counts && (depth > Real(0) || pressed);
    const Real friction = collider.coulomb != 0 ? collider.friction : Real(0);
    pair.normal = canonical(met.touch.normal);
    pair.over = canonical(depth + dot(pair.normal, weighted(pair, implicit.displacements)));
    pair.stiffness = met.counts ? stiffness : Real(0);
    pair.held = holds ? stiffness : Real(0);
    if (follows) pair.limit = canonical(holds ? friction * (stiffness * larger(depth, Real(0))) : Real(0));
    touching.carries[q] = canonical(met.touch.carry) - pair.elasticSlip;
    if (holds) std::atomic_ref(implicit.scalars.isDisturbed).store(1, std::memory_order_relaxed);
  });
}

namespace {

// What the solution leaves of Coulomb's friction [N], and the slip of the step, as the force of the pair.
template <class Real>
bool findSlip(const PassArguments<Real>& arguments, ImplicitState<Real>& implicit, std::uint32_t q) {
  TouchingPairs<Real>& touching = implicit.touching;
  SurfacePair<Real>& pair = touching.pairs[q];
  const Vec3<Real> relative = weighted(pair, implicit.displacements) - touching.carries[q],
                   slip = tangential(pair.normal, relative);
  const Real squared = dot(slip, slip), inverse = inverseSquareRoot(squared), length = squared * inverse;
  const Real used = frictionSlope(length, inverse, slowSlip(arguments.step)).over * length;
  pair.across = canonical(pair.limit * larger(Real(1) - used, Real(0)));
  touching.forces[q] = canonical(slip - tangential(pair.normal, pair.elasticSlip));
  return Real(0) < pair.across;
}

template <class Real>
Real mobilityOf(const PassArguments<Real>& arguments, const SurfacePair<Real>& pair) {
  Real mobility = 0;
  for (std::size_t k = 0; k < 3; ++k)
    mobility = mobility + (pair.weights[k] * pair.weights[k]) * arguments.inverseMasses[pair.particles[k]];
  return mobility;
}

// As far as it is deep in the collider.
template <class Real>
bool pushOut(const ClothSurface<Real>& surface, const PassArguments<Real>& arguments,
             TouchingPairs<Real>& touching, std::uint32_t q, bool onlyLooks, bool& passes) {
  SurfacePair<Real>& pair = touching.pairs[q];
  const SmallCollider<Real>& small = surface.colliders[pair.collider];
  const Met<Real> met = meet(arguments, small, pair, arguments.after.positions);
  const Real reach = reachOf(small), left = Real(LEFT_INSIDE) * (small.radius < reach ? small.radius : reach);
  passes = met.passes && left < met.touch.depth;
  if (onlyLooks) return false;
  pair.weights = met.weights;
  const Real push = met.touch.depth - Real(0.5) * left, mobility = mobilityOf(arguments, pair);
  const bool pushes = met.counts && left < met.touch.depth && Real(0) < mobility;
  pair.across = pushes ? reciprocal(mobility) : Real(0);
  touching.forces[q] = pushes ? canonical(push * met.touch.normal) : Vec3<Real>{};
  return pushes;
}

// Sums of what the pairs of a particle want, by weights.
template <class Real>
struct Wanted {
  Vec3<Real> sum{};
  Real parts = 0;
};
template <class Real>
Wanted<Real> wantedOf(const TouchingPairs<Real>& touching, std::uint32_t i, Real factor) {
  Wanted<Real> wanted;
  forEachPairOf(touching.all, i, [&](std::uint32_t q, std::uint32_t place) {
    const SurfacePair<Real>& pair = touching.pairs[q];
    if (pair.collider == NO_COLLIDER) return;
    const Real part = (pair.weights[place] * factor) * pair.across;
    wanted.sum = wanted.sum + part * touching.forces[q];
    wanted.parts = wanted.parts + part;
  });
  return wanted;
}

template <class Real>
void moveBy(const PassArguments<Real>& arguments, std::uint32_t i, Vec3<Real> moved) {
  Components<Real>&x = arguments.after.positions, &v = arguments.after.velocities;
  put(x, i, canonical(at(x, i) + moved));
  put(v, i, canonical(at(v, i) + arguments.step.inverseTimeStep * moved));
}

// The friction that is left stops the mean slip of a particle's pairs, or shortens it.
template <class Real>
void stopSlip(const PassArguments<Real>& arguments, const ImplicitState<Real>& implicit, std::uint32_t i) {
  const Real diagonal = implicit.diagonal[i];
  const auto [sum, friction] = wantedOf(implicit.touching, i, Real(1));
  if (!(Real(0) < friction) || !(Real(0) < diagonal)) return;
  const Vec3<Real> slip = reciprocal(friction) * sum;
  const Real lost = (friction * reciprocal(diagonal)) * inverseSquareRoot(dot(slip, slip));
  moveBy(arguments, i, -(lost < Real(1) ? lost : Real(1)) * slip);
}

// The mean of the pushes of a particle's pairs, where they want more than all of it. Returns whether there
// are any.
template <class Real>
bool push(const PassArguments<Real>& arguments, const TouchingPairs<Real>& touching, std::uint32_t i) {
  const auto [sum, parts] = wantedOf(touching, i, arguments.inverseMasses[i]);
  if (!(Real(0) < parts)) return false;
  moveBy(arguments, i, reciprocal(larger(parts, Real(1))) * sum);
  return true;
}

// Whether the last round pushed a corner of the pair: if it did not, the pair wants nothing, as before.
template <class Real>
bool isPushed(const TouchingPairs<Real>& touching, std::uint32_t q) {
  const auto& [a, b, c, same] = touching.pairs[q].particles;
  return (touching.pushed[a] | touching.pushed[b] | touching.pushed[c]) != 0;
}

}  // namespace

template <class Real>
void pressOut(const ClothSurface<Real>& surface, const PassArguments<Real>& arguments,
              ImplicitState<Real>& implicit, SurfaceState& state, std::uint32_t round) {
  TouchingPairs<Real>& touching = implicit.touching;
  const bool onlyCounts = round == PRESS_ROUNDS;
  std::atomic<std::uint32_t> passages{0}, moves{0};
  forEachColliderPair(touching, [&](std::uint32_t q) {
    if (round > 1 && !onlyCounts && !isPushed(touching, q)) return;
    bool passes = false;
    const bool wants = round == 0 ? findSlip(arguments, implicit, q)
                                  : pushOut(surface, arguments, touching, q, onlyCounts, passes);
    if (passes && onlyCounts) passages.fetch_add(1, std::memory_order_relaxed);
    if (wants) moves.store(1, std::memory_order_relaxed);
  });
  state.passages += passages;
  state.passageSteps += passages > 0 ? 1 : 0;
  const auto particles = static_cast<std::uint32_t>(implicit.diagonal.size());
  touching.pushed.assign(particles, 0);
  if (moves == 0) return;
  state.isPressed = 1;
  for (std::uint32_t i = 0; i < particles; ++i)
    if (round == 0)
      stopSlip(arguments, implicit, i);
    else
      touching.pushed[i] = push(arguments, touching, i) ? 1 : 0;
}

#define INSTANTIATE(Real)                                                                                   \
  template void addNearColliders(const ClothSurface<Real>&, const PassArguments<Real>&,                     \
                                 const ImplicitState<Real>&, const SurfaceTriangle&,                        \
                                 std::vector<SurfacePair<Real>>&);                                          \
  template void meetColliders(const ClothSurface<Real>&, const PassArguments<Real>&, ImplicitState<Real>&); \
  template void pressOut(const ClothSurface<Real>&, const PassArguments<Real>&, ImplicitState<Real>&,       \
                         SurfaceState&, std::uint32_t);
INSTANTIATE(float)
INSTANTIATE(double)
#undef INSTANTIATE

}  // namespace clothsim::cpu
