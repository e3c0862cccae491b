// The cloth as a surface that touches itself and other cloth, under solver.self_collision: "contact".
//
// A step looks twice for parts of the surface that are near each other: corners and triangles, sides and
// sides. First for those that may touch: they take part in the implicit step as stiff springs with friction
// (solver/implicit.h), so that layers lie on each other at the thickness of the fabric, however coarse the
// grid. At the end for those that the motion of the step could bring through each other: unless two such
// parts surely stay apart, they are pushed apart, and where that is not enough, their motions are cut short
// (docs/physics.md). So parts that have not crossed do not, in any step.
//
// In implicit steps it is also what small colliders act on, whether cloth touches itself or not.
//
// Both searches go through one tree of boxes over the triangles, whose order is that of the particles at the
// start along a space-filling curve; it never changes, so that pairs come in one order on every device.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "core/vec.h"
#include "shared/surface.h"
#include "solver/contact_counts.h"

namespace clothsim {

using SurfaceTriangle = shared::SurfaceTriangle;
template <class Real>
using SurfacePoint = shared::SurfacePoint<Real>;
template <class Real>
using SmallCollider = shared::SmallCollider<Real>;
using SurfaceState = shared::SurfaceState;
using SurfaceParams = shared::SurfaceParams;
using GuardRound = shared::GuardRound;
using SurfaceBlock = shared::SurfaceBlock;

inline constexpr std::uint32_t NO_COLLIDER = 0xffffffffu;

// Two parts that may touch: sum of weights times positions = distance times normal.
template <class Real>
struct SurfacePair {
  std::array<std::uint32_t, 4> particles;
  Vec3<Real> normal;
  Real distance;  // at the start of the step [m]
  std::array<Real, 4> weights;
  Real over;         // by how much they are nearer than they may be then [m]
  Real stiffness;    // [N/m]
  Real friction;     // Coulomb's coefficient
  Real pressed = 0;  // how they pressed in the Newton step before [N]
  Real limit = 0;    // of friction [N]; LARGE_SQUARE: not known yet
  Real held = 0;     // what the pair adds to the Hessian: its stiffness while it touches,
  Real across = 0;   // and friction's across the normal [N/m]
  // Of a triangle and a small collider, which of them; the fourth particle is the first once more, with
  // weight 0. What meets the collider says how friction is limited; `friction` and `pressed` stay 0.
  std::uint32_t collider = NO_COLLIDER;
  std::uint32_t place = 0;  // placeOf() of the triangle that has found the pair
  Vec3<Real> elasticSlip;   // of friction, at the start of the step [m],
  Real heldLimit = 0;       // and what held then (LEAST_HELD) [N]
};

// Pairs are found triangle by triangle, first those of cloth and cloth, then those with each small collider.
// What friction remembers of a pair is found again by this number and the particles.
[[nodiscard]] inline std::uint32_t placeOf(std::uint32_t triangle, std::uint32_t collider,
                                           std::size_t colliders) {
  const auto each = static_cast<std::uint32_t>(colliders) + 1;
  return triangle * each + (collider == NO_COLLIDER ? 0 : collider + 1);
}

template <class Real>
struct ClothSurface {
  std::vector<SurfaceTriangle> triangles;  // without those that cuts took
  std::vector<SurfacePoint<Real>> points;  // by particle
  // Of each particle the first of those that seams join to one place, itself included; empty without seams.
  // Parts that have one in common do not collide: seams close.
  std::vector<std::uint32_t> joints;
  // The particles around each, in the triangles that it is a corner of: where those of a particle begin, for
  // each and one more, then they.
  std::vector<std::uint32_t> rings;
  std::vector<std::uint32_t> firstBoxes;  // of each level, the finest first, and one more: how many there are
  std::vector<SurfaceBlock> blocks;       // of grids that are whole
  bool isOneGrid = false;                 // and nothing else is there
  Real touchingReach = 0;       // parts that may touch are nearer at the start or at the predicted end [m]
  Real around = 0;              // how far the search for those looks around each part [m]
  Real margin = 0;              // parts that are predicted to come so near count as pairs that may touch [m]
  Real largestPush = 0;         // that one pair asks for, where the step ends too near [m]
  std::uint32_t pairLimit = 0;  // a step that finds more pairs takes none
  std::uint32_t roomForPairs = 0;    // of the GPU, which makes more up to that limit
  Real quantum = 0, perQuantum = 0;  // of corrections [m], and its reciprocal
  Real leastGap = 0;                 // what motion leaves of a distance, if it was more [m]
  bool touchesItself = false;
  std::vector<SmallCollider<Real>> colliders;  // that act on triangles, too

  [[nodiscard]] std::array<std::uint32_t, 3> jointsOf(const SurfaceTriangle& t) const {
    if (joints.empty()) return {t.cornerA, t.cornerB, t.cornerC};
    return {joints[t.cornerA], joints[t.cornerB], joints[t.cornerC]};
  }
};

// Whether cloth touches itself and other cloth in the scene's steps.
[[nodiscard]] bool hasSurfaceContact(const Scene& scene);
// How many colliders implicit steps have that are small against the cells of a cloth, or end in such a tip:
// so small that they would pass between particles, or be deep in triangles before they meet one. These act on
// triangles, too.
[[nodiscard]] std::size_t smallColliders(const Scene& scene, const Cloth& cloth);
[[nodiscard]] inline bool hasSmallColliders(const Scene& scene, const Cloth& cloth) {
  return smallColliders(scene, cloth) > 0;
}
// How many of those that act on particles alone are so small that they can pass between them, unseen.
[[nodiscard]] std::size_t unseenColliders(const Scene& scene, const Cloth& cloth);
// At how many particles layers are thinner than their fabric, since half the shortest side there is less, and
// the thinnest of them, with the thickness of its fabric [m].
struct ThinnedLayers {
  std::size_t particles = 0;
  double least = INFINITY, fabric = 0;
};
[[nodiscard]] ThinnedLayers thinnedLayers(const Scene& scene, const Cloth& cloth);
// Whether steps have either.
[[nodiscard]] bool hasSurface(const Scene& scene, const Cloth& cloth);

// Before the first step.
[[nodiscard]] SurfaceState freshSurfaceState();
[[nodiscard]] ContactCounts countsOf(const SurfaceState& state);
void forgetCounts(SurfaceState& state);
// A gap as an integer that is ordered as gaps are.
template <class Real>
[[nodiscard]] inline std::uint32_t gapBits(Real gap) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(gap));
}

template <class Real>
[[nodiscard]] ClothSurface<Real> makeSurface(const Cloth& cloth, const Scene& scene, const Cuts& cuts);

}  // namespace clothsim
