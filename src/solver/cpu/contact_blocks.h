// Contacts of a block of particles at once, slot by slot through their candidates, in vector registers. In
// all of these, `candidates` is slot-major (slot * particles + particle), and without `nearCodes` all pairs
// have the same distance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/cpu/contact_pairs.h"
#include "solver/cpu/cpu_state.h"
#include "solver/cpu/rigid_motion.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

// Up to BLOCK particles of one piece.
struct Block {
  std::uint32_t begin, end;  // particles
  std::uint32_t piece;
  std::uint32_t slots = 0;  // most candidates of one of them; unused slots name the particle itself
};

// Particles of a grid by their place on it, whole numbers; those of different grids are never neighbours.
template <class Real>
struct LatticePlaces {
  std::vector<Real> columns, rows;
};

// Adds what each contact asks for to the particle's sums.
template <class Real>
void addContacts(bool robust, bool nearCodes, const View<Real>& view, const std::uint32_t* candidates,
                 const Block& block, Sums<Real>& sums);
// Moves every free particle by the mean over its contacts; the velocities go along.
template <class Real>
void moveByContacts(bool robust, const View<Real>& view, const Block& block, const Sums<Real>& sums,
                    Components<Real>& newPositions, Components<Real>& velocities);
// Whether some free particle has come nearer to a non-adjacent particle than D.
template <class Real>
[[nodiscard]] bool anyTooNear(bool nearCodes, const View<Real>& view, const std::uint32_t* candidates,
                              const Block& block);
// The positions of some particles, four numbers each, of which the last means nothing.
template <class Real>
void putFours(const Components<Real>& positions, Range particles, Real* fours);
// Whether some particle is not within sqrt(largestSquared) of where it was.
template <class Real>
[[nodiscard]] bool anyMovedFarther(const Components<Real>& now, const Components<Real>& then, Range particles,
                                   Real largestSquared);
// Whether some particle is not within sqrt(largestSquared) of where the motion has taken it.
[[nodiscard]] bool anyLeftMotion(const Components<float>& now, const Components<float>& then,
                                 const RigidMap<float>& motion, const Block& block, float largestSquared);
[[nodiscard]] bool anyLeftMotion(const Components<double>& now, const Components<double>& then,
                                 const RigidMap<double>& motion, const Block& block, double largestSquared);
template <class Real>
void copyBlock(const Components<Real>& from, Components<Real>& to, const Block& block);

}  // namespace clothsim::cpu
