// The compute programs of passes, compiled for what one grid's scene needs: springs, wind or colliders that
// are not there cost nothing, which matters on drivers that run both sides of a branch.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cloth/cloth.h"
#include "gl/program.h"
#include "scene/scene.h"
#include "shared/implicit.h"
#include "solver/interaction.h"
#include "solver/step_list.h"

namespace clothsim {

struct PassFeatures {
  bool wind = false, movingColliders = false, coulombFriction = false, movingPins = false,
       restLengthTable = false, material = false, mesh = false, seams = false;
  bool limitSprings = false;                     // the strain limit of the implicit integrator
  bool contactPlanes = false;                    // colliders in the implicit integrator
  bool history = false;                          // steps of second order
  bool surface = false;                          // pairs of parts of the surface that may touch
  bool smallColliders = false;                   // those that act on triangles
  bool grab = false, jet = false, cuts = false;  // the interaction
  bool externalForces = false;                   // of it, too
  std::uint32_t colliderTypes = 0;               // one bit a COLLIDER_... of shared/shapes.h
  std::uint32_t particleForces = 0;              // one bit a FORCE_... of shared/forces.h
  std::uint32_t enabledSlots = 0;                // one bit a SpringSlot
  int groupColumns = 64, groupRows = 1;          // of passes over grid points; others have as many in one row
  bool storageLoads = false;                     // the state at the start is read from storage blocks
  int coarseLanes = SUM_LANES;                   // of the work group that takes coarse levels alone
  int gate = 0;                                  // GATE_... of shared/implicit.h
  friend auto operator<=>(const PassFeatures&, const PassFeatures&) = default;
};

[[nodiscard]] PassFeatures featuresOf(const Scene& scene, const Cloth& cloth, std::size_t piece,
                                      const Interaction& interaction = {}, const Cuts& cuts = {});
// Those that a pass looks at, all others at their defaults: what it does not look at does not make another
// program of it.
[[nodiscard]] PassFeatures restricted(const PassFeatures& features, Features to);
[[nodiscard]] gl::Defines definesFor(const PassFeatures& features);

// What the invocations of a dispatch run over.
enum class Over : std::uint8_t {
  grids,          // grid points, a dispatch a cloth
  particles,      // of all cloths
  colors,         // springs of a colour, a dispatch a cloth
  slots,          // pairs of grid points of a slot of springs, a dispatch a cloth
  tiles,          // of grid points, a work group each, a dispatch a cloth
  levels,         // what the pass does of a level, a dispatch a cloth
  firstLevels,    // the same, of finest levels only
  furtherLevels,  // of all others only
  furtherBlocks,  // blocks of the matrices of those, a work group each, a dispatch a cloth
  restrictions,   // coarse vertices, level by level; the last dispatch takes several levels (LevelsInARow)
  prolongations,  // fine vertices of the levels that are left to do but for the finest, level by level
  parts,          // connected parts of coarsest levels, a work group each
  sumBlocks,      // blocks of particles that are summed up, a work group each
  once            // a single invocation
};

struct KernelStage {
  std::string shader;  // "forces" for shaders/sim/forces.comp
  Over over;
  gl::Defines defines = {};  // besides those of the features
};

// The cloths that a kernel is for.
enum class For : std::uint8_t {
  all,
  one,        // scenes with a single cloth
  sameSlots,  // grids whose limited springs are those of the same slots
  tiles,      // grids, on devices with fast shared memory
  groups      // any, on such devices
};

// What runs in one go: a pass, or several that have shaders together.
struct Kernel {
  // One that runs over levels stands for all of them, unless it is alone, and the strain limit in tiles for
  // all colours.
  std::vector<Pass> passes;
  std::vector<KernelStage> stages;  // one after the other
  For cloths = For::all;
  std::optional<Array> rewritten = {};  // what it writes while others still read the old
};
// All but those of self-collision, which has its own (gpu/self_collision.h).
[[nodiscard]] const std::vector<Kernel>& kernels();

// What decides between the kernels of a pass.
struct KernelOptions {
  bool fused = true;  // otherwise only those passes together that have no kernels of their own
  // Whether kernels for these may be taken.
  bool oneCloth = true, sameSlots = true, tiles = false, groups = false;
};

// The number of the kernel for the first of these passes, and how many of them it takes.
struct KernelChoice {
  std::size_t kernel, passes;
};
[[nodiscard]] KernelChoice kernelFor(std::span<const PassCall> passes, const KernelOptions& options = {});

// All programs that were ever needed: toggling back compiles nothing.
class PassLibrary {
 public:
  // One for each stage of the kernel. They live as long as the library. @throws OpenGlError when a shader
  // does not compile
  [[nodiscard]] std::vector<const gl::Program*> find(const Kernel& kernel, const PassFeatures& features);

 private:
  std::map<std::pair<std::string, PassFeatures>, gl::Program> programs_;  // the shader, and its defines
};

}  // namespace clothsim
