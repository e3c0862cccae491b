// Self-collision as both backends see it: distances, the hash and its margins, evaluated on the host.
//
// Two triangles of a lattice of spacing h, stretched by at most e, cannot cross unless two of their
// particles, one of each, are nearer than D = (1 + e) h (docs/physics.md). Where the spacings differ, h is
// sqrt((hx^2 + hy^2) / 2). Two particles are non-adjacent when they are not in one cell of a grid.
//
// "robust" pushes non-adjacent particles apart to d = max(thickness, D + delta / 2), where delta is the
// relative motion allowed for in a step. It never ends a step with a pair nearer than D that was not so
// before. "averaged" is CS184's rule: d = 2 thickness for all pairs. That lies below h and guarantees
// nothing.
//
// Sums over the contacts of a particle are made in fixed-point units of d / 2^18, which are exact in any
// order: neither threads, nor the order in a hash cell, nor candidates that are no contacts now can change a
// bit.
//
// On a mesh D = (1 + e) 0.764 L with L the longest edge (see crossingDistance()). Particles that no edge
// joins are non-adjacent there. Pairs nearer than d at rest keep that distance, rounded down to 64ths of d.
//
// The hash serves several steps. Non-adjacent particles within d now were within d + margin when it was
// built, as long as neither has moved farther than margin / 2 since. Every step begins by checking that, and
// builds the hash anew when it fails.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "shared/self_collision.h"

namespace clothsim {

template <class Real>
using SelfParams = shared::SelfParams<Real>;

// A fixed-point unit is d / 2^bits. Binary32: 2^13 contacts of full depth fit into 32 bits, and each is exact
// to d / 2^19.
template <class Real>
inline constexpr int FIXED_POINT_BITS = 18;
template <>
inline constexpr int FIXED_POINT_BITS<double> = 40;

// Whether there is anything to do: it is on, and d > 0.
[[nodiscard]] bool collidesWithItself(const Scene& scene, const Cloth& cloth);

// What thickness asks for: that of the thickest cloth, twice that under "averaged" [m].
[[nodiscard]] double thicknessDistance(const Scene& scene);

// d, the distance that the scene's self-collision keeps between non-adjacent particles [m]; at most 7
// spacings of the finest grid, so that every particle nearer at rest is known by its place on the lattice.
[[nodiscard]] double contactDistance(const Scene& scene, const Cloth& cloth);
// D for a stretch of e [m].
// h of a mesh: no two triangles whose edges are at most L cross unless two of their corners, one of each, are
// nearer than 0.764 L. The worst case is an edge whose middle is in the middle of an equilateral triangle,
// across it: sqrt((L/2)^2 + (L/sqrt 3)^2) = 0.7638 L; a search over random pairs found none beyond it.
[[nodiscard]] double crossingDistance(const Cloth& cloth, double stretch);
// The stretch that contacts are laid out for: the strain limit, or 0.25 without one.
[[nodiscard]] double expectedStrain(const Scene& scene);

template <class Real>
[[nodiscard]] SelfParams<Real> makeSelfParams(const Scene& scene, const Cloth& cloth);

// Distances kept between particles of a grid by code (shared/self_collision.h): d, and the distance at rest
// for those that are nearer than d then. NEAREST_CODES a grid [m]; of a mesh 64ths of d.
template <class Real>
[[nodiscard]] std::vector<Real> makeContactDistances(const Scene& scene, const Cloth& cloth);
// Whether any of them differs from d.
[[nodiscard]] bool hasNearCodes(const Scene& scene, const Cloth& cloth);

}  // namespace clothsim
