// The compute programs of passes, compiled for what one grid's scene needs: springs, wind or colliders that
// are not there cost nothing, which matters on drivers that run both sides of a branch.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cloth/cloth.h"
#include "gl/program.h"
#include "scene/scene.h"
#include "solver/interaction.h"
#include "solver/step_list.h"

namespace clothsim {

struct PassFeatures {
  bool wind = false, movingColliders = false, coulombFriction = false, movingPins = false,
       restLengthTable = false, material = false, mesh = false;
  bool limitSprings = false;                     // the strain limit of the implicit integrator
  bool contactPlanes = false;                    // colliders in the implicit integrator
  bool history = false;                          // steps of second order
  bool grab = false, jet = false, cuts = false;  // the interaction
  std::uint32_t colliderTypes = 0;               // one bit a COLLIDER_... of shared/shapes.h
  std::uint32_t particleForces = 0;              // one bit a FORCE_... of shared/forces.h
  std::uint32_t enabledSlots = 0;                // one bit a SpringSlot
  int groupColumns = 64, groupRows = 1;
  int gate = 0;  // GATE_... of shared/implicit.h
  friend auto operator<=>(const PassFeatures&, const PassFeatures&) = default;
};

[[nodiscard]] PassFeatures featuresOf(const Scene& scene, const Cloth& cloth, std::size_t piece,
                                      const Interaction& interaction = {}, const Cuts& cuts = {});
// Those that a pass looks at, all others at their defaults: what it does not look at does not make another
// program of it.
[[nodiscard]] PassFeatures restricted(const PassFeatures& features, Features to);
[[nodiscard]] gl::Defines definesFor(const PassFeatures& features);

// What runs in one go: a pass, or several that share a sweep.
struct Kernel {
  std::vector<Pass> passes;
  std::vector<std::string> shaders;  // dispatched one after the other: "forces" for shaders/sim/forces.comp
  gl::Defines defines;               // besides those of the features
};
// All but those of self-collision, which has its own (gpu/self_collision.h).
[[nodiscard]] const std::vector<Kernel>& kernels();
// The number of the kernel for the first of these passes, and as many that follow as it takes. With `fused`
// false only those together that have no kernels of their own.
[[nodiscard]] std::size_t kernelFor(std::span<const PassCall> passes, bool fused);

// All programs that were ever needed: toggling back compiles nothing.
class PassLibrary {
 public:
  // One for each shader of the kernel. They live as long as the library. @throws OpenGlError when a shader
  // does not compile
  [[nodiscard]] std::vector<const gl::Program*> find(const Kernel& kernel, const PassFeatures& features);

 private:
  std::map<std::pair<std::string, PassFeatures>, gl::Program> programs_;  // the shader, and its defines
};

}  // namespace clothsim
