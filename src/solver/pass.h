// The passes that steps are made of: what each is called, runs over, reads and writes. A step is a list of
// them (solver/step_list.h), which both backends execute.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace clothsim {

enum class Pass : std::uint8_t {
  // Outside of steps.
  checkStart,  // looks for what is not finite in a state that was handed in
  kick,        // turns the velocities of one integrator into those of another
  // An explicit step.
  forces,
  integrate,
  // An implicit step (solver/implicit.h).
  predictPlanes,
  begin,
  findPlanes,
  elasticForces,
  linearize,
  findCenters,
  coarsen,
  invertDense,
  restrict,
  solveCoarsest,
  prolong,
  sumFirstResidual,
  updateDirection,
  multiply,
  sumCurvature,
  updateSolution,
  sumNextResidual,
  stopAtPlanes,
  tryLengths,
  sumEnergies,
  accept,
  measureUpdate,
  end,
  remember,
  countStep,
  // The surface touching itself (solver/surface.h).
  findTouching,
  weighPairs,
  multiplyPairs,
  keepSlips,
  guard,
  shorten,
  settle,
  pressOut,
  // Contacts and limits, after either (solver/self_collision.h).
  checkHash,
  buildHash,
  findCandidates,
  resolveContacts,
  checkMotion,
  clampMotion,
  collide,
  limit,
  watchLimit
};
inline constexpr int PASS_COUNT = static_cast<int>(Pass::watchLimit) + 1;

// What passes hold in memory between them: an entry a particle, except where it says otherwise. Those marked
// with * go on with the coarse vertices.
enum class Array : std::uint8_t {
  positions,     // at the start of the step [m], and inverse masses
  velocities,    // at the start [m/s]
  newPositions,  // at the end
  newVelocities,
  forces,           // of springs and air [N]
  planes,           // in which particles touch colliders
  contactBlocks,    // what these do to the linear system
  elasticSlips,     // of friction in these planes, at the start of the step
  newElasticSlips,  // at the end
  histories,        // what the last step changed
  rightHandSides,   // b of inertia, air and grabs, and their diagonal
  airBlocks,        // what wind adds to the diagonal
  displacements,    // d, since the start of the step [m]
  iterates,         // x + d
  residuals,        // *
  corrections,      // * preconditioned residuals
  factors,          // of the diagonal blocks
  centers,          // of coarse vertices [m]
  coarseBlocks,     // of the coarse levels' matrices
  coarseInverses,   // of their diagonal blocks, an entry a coarse vertex
  dense,            // inverses of the coarsest levels' matrices
  directions,       // of conjugate gradients
  products,         // H times the direction; also the changes of energy that the line search looks at
  increments,       // the Newton step so far
  partialSums,      // one a block of particles
  scalars,          // of conjugate gradients and the line search
  hash,             // of the cells that particles lie in
  candidates,       // for contact, a list a particle
  touching,         // pairs of parts of the surface that may touch
  pairSlips,        // of friction between these parts, at the start of the step
  newPairSlips,     // at the end
  pairForces,       // what these do
  keptMotions,      // how much of its motion each particle keeps
  safePositions,    // where motion was cut short, and from where the step goes on
  contactFlags,     // whether the hash is stale, whether motion has to be clamped
  watch             // what the watchdog has found
};
inline constexpr int ARRAY_COUNT = static_cast<int>(Array::watch) + 1;
[[nodiscard]] std::string_view nameOf(Array array);

// A set of small enumerators.
template <class Enum>
class SetOf {
 public:
  constexpr SetOf() = default;
  constexpr SetOf(std::initializer_list<Enum> members) {
    for (const Enum member : members) bits_ |= bitOf(member);
  }
  [[nodiscard]] constexpr bool contains(Enum member) const { return (bits_ & bitOf(member)) != 0; }
  [[nodiscard]] constexpr bool overlaps(SetOf other) const { return (bits_ & other.bits_) != 0; }
  [[nodiscard]] constexpr bool isEmpty() const { return bits_ == 0; }
  friend constexpr SetOf operator|(SetOf a, SetOf b) {
    a.bits_ |= b.bits_;
    return a;
  }
  friend constexpr auto operator<=>(SetOf, SetOf) = default;

 private:
  static constexpr std::uint64_t bitOf(Enum member) { return std::uint64_t{1} << static_cast<int>(member); }
  std::uint64_t bits_ = 0;
};
using Arrays = SetOf<Array>;

// What of a scene a pass computes with, beside gravity, time step and masses.
enum class Feature : std::uint8_t {
  springs,         // of a grid's slots, bending, and those that limit strain in implicit steps
  restLengths,     // a rest length of its own for each spring
  meshes,          // triangle meshes
  wind,            // and gusts
  particleForces,  // those on single particles: shared/forces.h
  jets,
  grabs,
  externalForces,  // on single particles, by another program
  cuts,
  movingPins,
  colliders,
  planes,   // colliders in implicit steps
  history,  // steps of second order
  surface,  // the surface that touches itself
  smallColliders,
  seams,
};
inline constexpr int FEATURE_COUNT = static_cast<int>(Feature::seams) + 1;
[[nodiscard]] std::string_view nameOf(Feature feature);
using Features = SetOf<Feature>;

// What a pass runs over, one entry after the other or all at once.
enum class Domain : std::uint8_t {
  gridPoints,      // the particles of each cloth, by rows; each has neighbours
  particles,       // all particles, without knowing their cloth
  springs,         // those of one colour, of which no two share a particle
  coarseVertices,  // of a level of the preconditioner
  coarseBlocks,    // of its matrix
  fineVertices,    // of the next finer level
  sums,            // all particles, to one number
  contacts,        // particles and the cells they lie in
  surface          // triangles, and pairs of their parts
};
[[nodiscard]] std::string_view nameOf(Domain domain);

// When a pass of an implicit step does nothing any more. What closes later comes first.
enum class Gate : std::uint8_t {
  none,   // never
  step,   // once the step is solved
  system  // once the linear system is
};

struct PassTraits {
  Pass pass;
  std::string_view name;  // for timings, the watchdog and people
  Domain domain;
  int reach;  // how many rows beyond its own it reads of a grid; of a mesh, or through a seam, it may read
              // everything
  Arrays gathers;  // read at neighbours within reach, too,
  Arrays reads;    // at its own entry only
  Arrays writes;   // at its own entry
  Features features;
  Gate gate = Gate::none;
};
[[nodiscard]] const PassTraits& traitsOf(Pass pass);
[[nodiscard]] inline std::string nameOf(Pass pass) { return std::string(traitsOf(pass).name); }

// Whether `later` may run for a row as soon as `earlier` is done for it, while other rows wait: neither reads
// at neighbours what the other writes.
[[nodiscard]] bool canShareSweep(const PassTraits& earlier, const PassTraits& later);

}  // namespace clothsim
