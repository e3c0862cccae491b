#include "solver/cpu/surface_pairs.h"

#include <algorithm>

#include "core/thread_team.h"
#include "solver/cpu/implicit_contact.h"

namespace clothsim::cpu {
namespace {

constexpr std::uint32_t PAIRS_AT_ONCE = 256;

// Whether a side is the nearest part of both triangles at it.
template <class Real>
bool isNearestSide(const SurfaceTriangle& triangle, std::uint32_t k, Vec3<Real> way,
                   const Components<Real>& x) {
  const auto corners = cornersOf(triangle);
  const std::uint32_t across = acrossOf(triangle)[k];
  const auto isNearest = [&](std::uint32_t outer) {
    return SurfaceLaws<Real>::isStillNearest(way, at(x, outer) - at(x, corners[k]));
  };
  return isNearest(corners[(k + 2) % 3]) && (across == NO_PARTICLE || isNearest(across));
}

// The part of a contact that a pair of parts finds: all where both are faces or sides, half at a side that
// another triangle has, too; nothing where other parts are nearer, or a triangle has the corner itself.
template <class Real>
Real shareOf(const ClothSurface<Real>& surface, const Parts& parts, Vec3<Real> way, std::uint32_t part,
             const Components<Real>& x) {
  const SurfaceTriangle& triangle = surface.triangles[parts.second];
  if (parts.areSides) {
    const bool isContact = part == NEAREST_FACE && isNearestSide(triangle, parts.l, way, x) &&
                           isNearestSide(surface.triangles[parts.first], parts.k, Vec3<Real>{} - way, x);
    return isContact ? Real(1) : Real(0);
  }
  if (part == NEAREST_FACE) return 1;
  const auto corners = cornersOf(triangle), across = acrossOf(triangle);
  const auto isNearest = [&](std::uint32_t outer, std::uint32_t corner) {
    return outer != parts.particles[0] &&
           SurfaceLaws<Real>::isStillNearest(way, at(x, outer) - at(x, corner));
  };
  if (part >= NEAREST_SIDE) {
    const std::uint32_t k = part - NEAREST_SIDE;
    if (across[k] == NO_PARTICLE) return 1;
    return isNearest(across[k], corners[k]) ? Real(0.5) : Real(0);
  }
  const std::uint32_t corner = corners[part - NEAREST_CORNER], *ring = surface.rings.data();
  for (std::uint32_t k = ring[corner]; k < ring[corner + 1]; ++k)
    if (!isNearest(ring[k], corner)) return 0;
  return surface.points[corner].share;
}

// The pair as it is at the places x: those of the start, or moved by the displacements.
template <class Real>
SurfacePair<Real> pairAt(const ClothSurface<Real>& surface, const Parts& parts,
                         const typename SurfaceLaws<Real>::NearestParts& nearest, const Components<Real>& x,
                         const ImplicitState<Real>& implicit, bool isMoved) {
  const auto& [way, u, v, part] = nearest;
  const Real squared = dot(way, way), inverse = inverseSquareRoot(squared);
  SurfacePair<Real> pair{};
  pair.distance = squared * inverse;
  pair.normal = canonical(inverse * way);
  pair.particles = parts.particles;
  pair.weights = weightsOf<Real>(parts, nearest);
  Real reach = 0, inertia = 0, springs = 0, weights = 0, friction = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const SurfacePoint<Real>& point = surface.points[parts.particles[k]];
    const Real w = pair.weights[k], size = w < Real(0) ? -w : w, square = w * w;
    reach = reach + size * point.radius;
    friction = friction + size * point.friction;
    inertia = inertia + square * implicit.diagonal[parts.particles[k]];
    springs = springs + square * point.stiffness;
    weights = weights + square;
  }
  const Real along = dot(pair.normal, weighted(pair, implicit.displacements)),
             predicted = isMoved ? pair.distance : pair.distance + along;
  if (!((predicted < pair.distance ? predicted : pair.distance) < reach + surface.margin)) return pair;
  const Real gap = larger(pair.distance, static_cast<Real>(SQUEEZED) * reach), half = Real(0.5) * reach;
  const Real squeezed = (reach * reach) * reciprocal((Real(4) * gap) * (reach - gap));
  const Real stiffness = static_cast<Real>(PAIR_OVER_INERTIA) * (inertia * reciprocal(weights)) + springs;
  const Real over = reach - pair.distance;
  pair.over = canonical(isMoved ? over + along : over);
  pair.stiffness = shareOf(surface, parts, way, part, x) * (gap < half ? stiffness * squeezed : stiffness);
  pair.friction = Real(0.5) * friction;
  pair.pressed = static_cast<Real>(LARGE_SQUARE);
  pair.held = pair.over - along > Real(0) ? pair.stiffness : Real(0);
  return pair;
}

}  // namespace

template <class Real>
SurfacePair<Real> pairOf(const ClothSurface<Real>& surface, const Parts& parts,
                         const typename SurfaceLaws<Real>::NearestParts& nearest, const Components<Real>& x,
                         const ImplicitState<Real>& implicit, bool isLater) {
  if (isLater) return pairAt(surface, parts, nearest, x, implicit, true);
  Vec3<Real> before[4], after[4];
  for (std::size_t k = 0; k < 4; ++k) {
    before[k] = at(x, parts.particles[k]);
    after[k] = at(implicit.iterate.positions, parts.particles[k]);
  }
  const auto then = SurfaceLaws<Real>::nearestParts(parts.areSides, after[0], after[1], after[2], after[3]);
  if (!SurfaceLaws<Real>::passesBy(parts.areSides, before, after, nearest.way, then.way, surface.leastGap))
    return pairAt(surface, parts, nearest, x, implicit, false);
  SurfacePair<Real> pair = pairAt(surface, parts, then, implicit.iterate.positions, implicit, true);
  if (!(pair.held > Real(0)) && !SurfaceLaws<Real>::turnsLittle(nearest.way, then.way)) return {};
  const Real squared = dot(nearest.way, nearest.way);
  pair.distance = squared * inverseSquareRoot(squared);
  return pair;
}

namespace {

// Of `count` pairs, whose numbers numberOf(0), numberOf(1) ... ascend.
template <class Real, class NumberOf>
void listByParticle(const std::vector<SurfacePair<Real>>& pairs, std::size_t count, const NumberOf& numberOf,
                    std::size_t particles, PairLists& lists) {
  // One too many: while entries come, starts[i + 1] is where the next one of i goes.
  lists.starts.assign(particles + 2, 0);
  for (std::size_t k = 0; k < count; ++k)
    for (const std::uint32_t i : pairs[numberOf(k)].particles) ++lists.starts[i + 2];
  for (std::size_t i = 0; i < particles; ++i) lists.starts[i + 2] += lists.starts[i + 1];
  lists.entries.resize(4 * count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t q = numberOf(k);
    for (std::uint32_t corner = 0; corner < 4; ++corner)
      lists.entries[lists.starts[pairs[q].particles[corner] + 1]++] = 4 * q + corner;
  }
}

// Few of the pairs that may touch do, and a product with the Hessian sees only those.
template <class Real>
void listActing(TouchingPairs<Real>& touching, std::size_t particles) {
  touching.acting.clear();
  for (std::uint32_t q = 0; q < touching.pairs.size(); ++q)
    if (touching.pairs[q].held > Real(0) || touching.pairs[q].across > Real(0)) touching.acting.push_back(q);
  listByParticle(
      touching.pairs, touching.acting.size(), [&](std::size_t k) { return touching.acting[k]; }, particles,
      touching.ofActing);
}

}  // namespace

template <class Real>
void listPairs(TouchingPairs<Real>& touching, std::size_t particles) {
  listByParticle(
      touching.pairs, touching.pairs.size(), [](std::size_t k) { return static_cast<std::uint32_t>(k); },
      particles, touching.all);
}

template <class Real>
void weighPairs(ImplicitState<Real>& own, const StepParams<Real>& step) {
  TouchingPairs<Real>& touching = own.touching;
  const auto weigh = [&](std::uint32_t q) {
    SurfacePair<Real>& pair = touching.pairs[q];
    const Vec3<Real> moved = weighted(pair, own.displacements);
    const Real along = dot(pair.normal, moved), over = pair.over - along;
    const Vec3<Real> slip = tangential(pair.normal, moved - touching.carries[q]);
    const Real squared = dot(slip, slip), inverse = inverseSquareRoot(squared);
    if (pair.collider == NO_COLLIDER) {
      // Where cloth is predicted to come it presses a hundred times too much, so that the first Newton step
      // knows friction only of what held when the last step ended. Then the less of this and the last Newton
      // step: what is not solved yet presses at random, and would stick.
      const Real press = pair.stiffness * larger(over, Real(0));
      const bool isFirst = own.scalars.newtonSteps == 0, held = isFirst && pair.heldLimit > Real(0),
                 isNew = !(pair.pressed < static_cast<Real>(LARGE_SQUARE));
      if (isFirst)
        pair.limit = limitOf(pair.heldLimit);
      else if (isNew || frictionFollows(own))
        pair.limit = canonical(pair.friction * (press < pair.pressed ? press : pair.pressed));
      pair.pressed = canonical(press);
      pair.held = held || over > Real(0) ? pair.stiffness : Real(0);
    }
    const Real across = pair.limit * frictionSlope(squared * inverse, inverse, slowSlip(step)).over;
    pair.across = canonical(across);
    touching.forces[q] = canonical((pair.held * over) * pair.normal - across * slip);
  };
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(touching.pairs.size()), PAIRS_AT_ONCE, weigh);
  listActing(touching, own.displacements.x.size());
}

// Pairs that the step before has found, too, begin with the friction that it ended with.
template <class Real>
void recallSlips(ImplicitState<Real>& own) {
  TouchingPairs<Real>& touching = own.touching;
  touching.carries.resize(touching.pairs.size());
  const auto recall = [&](std::uint32_t q) {
    SurfacePair<Real>& pair = touching.pairs[q];
    pair.elasticSlip = {};
    pair.heldLimit = 0;
    auto known = std::ranges::lower_bound(own.pairSlips, pair.place, {}, &RememberedSlip<Real>::place);
    while (known != own.pairSlips.end() && known->place == pair.place && known->particles != pair.particles)
      ++known;
    if (known != own.pairSlips.end() && known->place == pair.place) {
      pair.elasticSlip = known->slip;
      pair.heldLimit = known->heldLimit;
    }
    touching.carries[q] = Vec3<Real>{} - pair.elasticSlip;
  };
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(touching.pairs.size()), PAIRS_AT_ONCE, recall);
}

// As of planes (implicit_ends.cpp).
template <class Real>
void keepSlips(ImplicitState<Real>& own, const StepParams<Real>& step) {
  const TouchingPairs<Real>& touching = own.touching;
  own.newPairSlips.resize(touching.pairs.size());
  const Real slow = slowSlip(step);
  const auto keep = [&](std::uint32_t q) {
    const SurfacePair<Real>& pair = touching.pairs[q];
    const Vec3<Real> slip = tangential(pair.normal, weighted(pair, own.displacements) - touching.carries[q]);
    const Real part = slow * inverseSquareRoot(dot(slip, slip));
    const Vec3<Real> elastic = canonical((part < Real(1) ? part : Real(1)) * slip);
    own.newPairSlips[q] = {pair.place, pair.particles, pair.limit > Real(0) ? elastic : Vec3<Real>{},
                           heldLimit(pair.held > Real(0), pair.limit)};
  };
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(touching.pairs.size()), PAIRS_AT_ONCE, keep);
}

template <class Real>
void multiplyPairs(ImplicitState<Real>& own) {
  TouchingPairs<Real>& touching = own.touching;
  const auto multiply = [&](std::uint32_t k) {
    const std::uint32_t q = touching.acting[k];
    const SurfacePair<Real>& pair = touching.pairs[q];
    const Vec3<Real> moved = weighted(pair, own.directions.positions);
    const Real beyond = (pair.held - pair.across) * dot(pair.normal, moved);
    touching.forces[q] = canonical(pair.across * moved + beyond * pair.normal);
  };
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(touching.acting.size()), PAIRS_AT_ONCE,
                               multiply);
}

#define INSTANTIATE(Real)                                                                       \
  template SurfacePair<Real> pairOf(const ClothSurface<Real>&, const Parts&,                    \
                                    const typename SurfaceLaws<Real>::NearestParts&,            \
                                    const Components<Real>&, const ImplicitState<Real>&, bool); \
  template void listPairs(TouchingPairs<Real>&, std::size_t);                                   \
  template void weighPairs(ImplicitState<Real>&, const StepParams<Real>&);                      \
  template void recallSlips(ImplicitState<Real>&);                                              \
  template void keepSlips(ImplicitState<Real>&, const StepParams<Real>&);                       \
  template void multiplyPairs(ImplicitState<Real>&);
INSTANTIATE(float)
INSTANTIATE(double)

}  // namespace clothsim::cpu
