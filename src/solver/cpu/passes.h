// The passes of a step on the CPU, each over a stretch of one piece row or over one colour of springs. They
// are the twins of shaders/sim/*.glsl: same names, same order of operations. Real is float for the bitwise
// twin, double for the physics tests.
#pragma once

#include <cstdint>

#include "cloth/cloth.h"
#include "solver/cpu/cpu_state.h"
#include "solver/cpu/mesh_stretches.h"
#include "solver/divergence.h"
#include "solver/interaction.h"
#include "solver/mesh_lists.h"
#include "solver/pin_paths.h"
#include "solver/step_params.h"

namespace clothsim::cpu {

template <class Real>
struct SymmetricField;  // symmetric.h
template <class Real>
class ForceRows;  // force_rows.h

// Everything a pass reads and writes; `before` is the state at the start of the step, `after` the one at its
// end.
template <class Real>
struct PassArguments {
  const StepParams<Real>& step;
  const ColliderParams<Real>* colliders;    // those of this step
  const float* distances;                   // samples of the mesh colliders' grids; null without any
  const PinMotionParams<Real>* pinMotions;  // those of this step,
  const std::uint32_t* pinPathNumbers;  // for each particle one of them + 1, or 0; null when there are none
  const Components<Real>& pinStarts;    // where the simulation began [m]; empty when there are none
  const Real* inverseMasses;
  const Real* restLengths;                     // slot-major; null when no grid needs the table
  const MeshLists<Real>& lists;                // of all meshes; empty without any
  const MeshStretches<Real>& stretches;        // the same
  const InteractionParams<Real>& interaction;  // of this step
  const GrabSpring::Point* grabbed;  // the block of this grid that is grabbed, row-major; null without
  bool jet;                          // whether air blows from `interaction`
  const std::uint32_t* cutMasks;     // makeCutMasks(); null without cuts
  const Particle4* externalForces;   // on each particle [N]; null without
  const CpuState<Real>& before;
  CpuState<Real>& after;
  Components<Real>& forces;  // springs, wind and air, without gravity [N]
  WatchRow& watch;           // of this step; rows and threads write to it atomically
};

// The same arguments over another state at the start, with other forces and other parameters.
template <class Real>
PassArguments<Real> withState(const PassArguments<Real>& of, const StepParams<Real>& step,
                              const CpuState<Real>& before, Components<Real>& forces) {
  return {step,           of.colliders,     of.distances,   of.pinMotions, of.pinPathNumbers,
          of.pinStarts,   of.inverseMasses, of.restLengths, of.lists,      of.stretches,
          of.interaction, of.grabbed,       of.jet,         of.cutMasks,   of.externalForces,
          before,         of.after,         forces,         of.watch};
}

// Looks for what is not finite in the state that a step begins with.
void checkStart(const PassArguments<float>& arguments, int row);
void checkStart(const PassArguments<double>& arguments, int row);

// One row of the grid, or of a mesh (rows.h). `rows` keeps what the next row needs, too.
void gatherForces(const PassArguments<float>& arguments, int row, ForceRows<float>& rows);
void gatherForces(const PassArguments<double>& arguments, int row, ForceRows<double>& rows);
void integrate(const PassArguments<float>& arguments, int row);
void integrate(const PassArguments<double>& arguments, int row);
// The forces of the wind alone, and the matrices by which it resists velocities [N s/m] (implicit).
void gatherWind(const PassArguments<float>& arguments, int row, SymmetricField<float>& resistance);
void gatherWind(const PassArguments<double>& arguments, int row, SymmetricField<double>& resistance);
// Where their paths take the pins, into `after`; pins without a path are left alone.
template <class Real>
void movePins(const PassArguments<Real>& arguments, int row);
// after.velocities = before.velocities + kickTime * acceleration, positions untouched.
template <class Real>
void kick(const PassArguments<Real>& arguments, int row);

// The springs of the colour that particles of a row of a grid own; works in place on `after`.
void limitRow(const PassArguments<float>& arguments, const LimitColor& color, int row);
void limitRow(const PassArguments<double>& arguments, const LimitColor& color, int row);
// Row j of the colour's owners, or of a mesh its springs from j MESH_ROW on; works in place on `after`.
void limitStrain(const PassArguments<float>& arguments, const LimitColor& color, std::uint32_t j);
void limitStrain(const PassArguments<double>& arguments, const LimitColor& color, std::uint32_t j);
[[nodiscard]] std::uint32_t limitRows(const Piece& piece, const LimitColor& color);  // how many j there are
// After all colours: the watchdog's look at a row.
void watchLimit(const PassArguments<float>& arguments, int row);
void watchLimit(const PassArguments<double>& arguments, int row);

}  // namespace clothsim::cpu
