// The passes of an implicit step on the CPU, each over a row of a grid; the twins of
// shaders/sim/implicit/*.comp: same names, same order of operations. The method is at solver/implicit.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/cpu/collide.h"
#include "solver/cpu/grid_product.h"
#include "solver/cpu/mesh_products.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/piece_ranges.h"
#include "solver/cpu/prolongation.h"
#include "solver/cpu/rigid_block.h"
#include "solver/cpu/symmetric.h"
#include "solver/hierarchy.h"
#include "solver/implicit.h"
#include "solver/surface.h"

namespace clothsim::cpu {

// Of some pairs, those of each particle.
struct PairLists {
  std::vector<std::uint32_t> starts;   // of a particle's entries, and one more
  std::vector<std::uint32_t> entries;  // 4 * pair + place in it, ascending
};

// The vertices of each level that passes work on, of all cloths, and the coarsest levels' parts.
struct LevelRanges {
  std::vector<PieceRanges> fine, coarse;  // by level
  PieceRanges parts;
};
template <class Real>
[[nodiscard]] LevelRanges levelRangesOf(const Hierarchy<Real>& hierarchy);

// Parts of the surface that may touch in this step (solver/surface.h); empty without contact.
template <class Real>
struct TouchingPairs {
  std::vector<SurfacePair<Real>> pairs;
  std::vector<Vec3<Real>> forces;  // of a pair: at the iterate, later what it does to the directions
  PairLists all;
  // The pairs that press or rub in this Newton step, ascending, and each particle's.
  std::vector<std::uint32_t> acting;
  PairLists ofActing;
  // Of each pair, how far a small collider carries it along, less the elastic slip [m].
  std::vector<Vec3<Real>> carries;
  std::vector<std::uint8_t> pushed;  // particles: 1 if the last round pushed them out of small colliders
};

// What friction remembers of a pair.
template <class Real>
struct RememberedSlip {
  std::uint32_t place;
  std::array<std::uint32_t, 4> particles;
  Vec3<Real> slip;
  Real heldLimit;  // LEAST_HELD
};

// What an implicit step works on, an entry a particle.
template <class Real>
struct ImplicitState {
  Components<Real> rightHandSide;      // b and
  std::vector<Real> diagonal;          // a of the energy 1/2 a |d|^2 - b.d of inertia, air and grabs
  SymmetricField<Real> air;            // what the air adds to a; empty without wind
  ContactPlanes<Real> planes;          // of particles in colliders; empty without colliders
  Components<Real> movedBefore;        // of `bdf2`: a third of what place [m]
  Components<Real> acceleratedBefore;  // and velocity [m/s] changed in the step before
  Components<Real> displacements;      // d of the step so far [m]
  CpuState<Real> iterate;              // x + d; no velocities
  Components<Real> residuals;          // r
  Components<Real> corrections;        // z
  GridElements<Real> elements;         // at the iterate
  MembraneTensions<Real> membranes;    // empty without meshes
  SymmetricField<Real> factors;        // L D L^T of diagonal blocks: 1/d1 1/d2 1/d3 and l21 l31 l32
  CpuState<Real> directions;           // p; no velocities
  Components<Real> products;           // H p
  Components<Real> increments;         // the Newton step so far
  std::array<std::vector<Real>, LENGTHS_TRIED> trials;  // a particle's change of energy
  bool triesShorter = false;  // lengths behind the first are tried only where that one raises the energy
  TouchingPairs<Real> touching;
  std::vector<RememberedSlip<Real>> pairSlips;     // of the step before, ascending by place,
  std::vector<RememberedSlip<Real>> newPairSlips;  // and of this one
  ImplicitScalars<Real> scalars{};

  Hierarchy<Real> hierarchy;
  ProlongationBySixteen<Real> toParticles;
  LevelRanges levelRanges;
  // The residuals of vertices of all levels: force, and torque about the first particle.
  std::vector<RigidVector<Real>> forces;
  // Of coarse vertices.
  std::vector<Four<Real>> centers;  // [m]
  std::vector<RigidVector<Real>> coarseCorrections;
  std::vector<RigidBlock<Real>> coarseBlocks;    // of the levels' matrices
  std::vector<ElementSums<Real>> elementSums;    // of the first levels' blocks
  std::vector<RigidBlock<Real>> coarseInverses;  // minus those of the diagonal blocks, by coarse vertex
  std::vector<Real> dense;                       // minus the inverses of the coarsest levels' matrices

  // Without planes.
  void resize(Hierarchy<Real> levels, std::size_t meshMembranes);
};

template <class Real>
struct ImplicitArguments {
  PassArguments<Real> step;
  ImplicitState<Real>& own;
};

// The planes of particles that are in a collider where their velocities take them, and of the others those
// where inertia and gravity alone would take them; says whether what touches is not what touched before.
template <class Real>
void predictPlanes(const ImplicitArguments<Real>& arguments, int row);
// Right-hand side and diagonal; the search starts on with the velocities, but on the planes, and pins go
// where their paths take them.
template <class Real>
void begin(const ImplicitArguments<Real>& arguments, int row);
// step.forces = those of springs and bending at the iterate.
template <class Real>
void gatherElasticForces(const ImplicitArguments<Real>& arguments, int row, ForceRows<Real>& rows);
// From the elastic forces at the iterate, in step.forces: which planes hold and what friction does,
// residuals, blocks of the preconditioner; clears the increments.
void linearize(const ImplicitArguments<float>& arguments, int row);
void linearize(const ImplicitArguments<double>& arguments, int row);
// products = H directions
void multiply(const ImplicitArguments<float>& arguments, int row, ForceRows<float>& rows);
void multiply(const ImplicitArguments<double>& arguments, int row, ForceRows<double>& rows);
// directions = corrections + kept * directions
void updateDirection(const ImplicitArguments<float>& arguments, int row);
void updateDirection(const ImplicitArguments<double>& arguments, int row);
// increments += stepSize * directions, residuals -= stepSize * products
void updateSolution(const ImplicitArguments<float>& arguments, int row);
void updateSolution(const ImplicitArguments<double>& arguments, int row);
// Cuts short the increments of particles that no plane holds and that would cross theirs.
void stopAtPlanes(const ImplicitArguments<float>& arguments, int row);
void stopAtPlanes(const ImplicitArguments<double>& arguments, int row);
// trials: how the energy would change along the increments, by the first of the lengths or by the others.
void tryLengths(const ImplicitArguments<float>& arguments, int row);
void tryLengths(const ImplicitArguments<double>& arguments, int row);
// displacements += newtonLength * increments
void accept(const ImplicitArguments<float>& arguments, int row);
void accept(const ImplicitArguments<double>& arguments, int row);
// Positions and velocities at the end of the step.
template <class Real>
void end(const ImplicitArguments<Real>& arguments, int row);
// What the step has changed, and whether contacts had a part in it that the solution does not know.
template <class Real>
void remember(const ImplicitArguments<Real>& arguments, int row);

// Where an aggregate is.
template <class Real>
void findCenter(ImplicitState<Real>& own, std::uint32_t coarse);
// The blocks of the rows [first, end) of a coarse matrix, and the inverses of those on the diagonal.
template <class Real>
void coarsen(const ImplicitArguments<Real>& arguments, const LevelParams& level, std::uint32_t first,
             std::uint32_t end);
// Minus the inverse of the matrix of a connected part of the coarsest level.
void invertDense(ImplicitState<float>& own, const DensePart& part);
void invertDense(ImplicitState<double>& own, const DensePart& part);
// `forces` of the particles [first, end): their residuals, and the torques of these about the first particle.
void putForces(ImplicitState<float>& own, std::uint32_t first, std::uint32_t end);
void putForces(ImplicitState<double>& own, std::uint32_t first, std::uint32_t end);
// `forces` of the aggregates [first, end): the weighted sums of those of what hangs on them.
void restrictResiduals(ImplicitState<float>& own, std::uint32_t first, std::uint32_t end);
void restrictResiduals(ImplicitState<double>& own, std::uint32_t first, std::uint32_t end);
// z of the coarsest level's vertices in a connected part.
void solveCoarsest(ImplicitState<float>& own, const DensePart& part);
void solveCoarsest(ImplicitState<double>& own, const DensePart& part);
// z of the coarse vertices [first, end): their own and what the next coarser level makes of them.
void prolong(ImplicitState<float>& own, std::uint32_t first, std::uint32_t end);
void prolong(ImplicitState<double>& own, std::uint32_t first, std::uint32_t end);
// z of the particles [first, end), at most PARTICLES_AT_ONCE. Pinned ones get 0.
inline constexpr std::uint32_t PARTICLES_AT_ONCE = 256;
void prolongParticles(ImplicitState<float>& own, const float* inverseMasses, std::uint32_t first,
                      std::uint32_t end);
void prolongParticles(ImplicitState<double>& own, const double* inverseMasses, std::uint32_t first,
                      std::uint32_t end);

}  // namespace clothsim::cpu
