// The compute programs of a step, compiled for what one grid's scene needs: springs, wind or colliders that
// are not there cost nothing, which matters on drivers that run both sides of a branch.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "cloth/cloth.h"
#include "gl/program.h"
#include "scene/scene.h"
#include "solver/hand.h"

namespace clothsim {

struct PassFeatures {
  bool wind = false, airResistance = false, movingColliders = false, coulombFriction = false,
       movingPins = false, restLengthTable = false, material = false, mesh = false;
  bool limitSprings = false;                     // the strain limit of the implicit integrator
  bool contactPlanes = false;                    // colliders in the implicit integrator
  bool hold = false, jet = false, cuts = false;  // a hand's doing
  std::uint32_t colliderTypes = 0;               // one bit a COLLIDER_... of shared/shapes.h
  std::uint32_t enabledSlots = 0;                // one bit a SpringSlot
  int groupColumns = 64, groupRows = 1;
  bool fused = true;           // forces and integration in one dispatch,
  bool collidesInStep = true;  // and colliders, when no pass comes between;
  bool collidesAgain = false;  // they come again later
  int sumKind = 0;             // SUM_... of shared/implicit.h
  friend auto operator<=>(const PassFeatures&, const PassFeatures&) = default;
};

[[nodiscard]] PassFeatures featuresOf(const Scene& scene, const Cloth& cloth, std::size_t grid,
                                      const Hand& hand = {}, const Cuts& cuts = {});
[[nodiscard]] gl::Defines definesFor(const PassFeatures& features);

// Those of a grid. Null where a scene has no use for one.
struct PassPrograms {
  const gl::Program* step = nullptr;                                              // when fused,
  const gl::Program *forces = nullptr, *integrate = nullptr, *collide = nullptr;  // when not
  const gl::Program *limit = nullptr, *watchLimit = nullptr, *kick = nullptr, *start = nullptr;
};

// All programs that were ever needed: toggling back compiles nothing, and what a pass does not look at does
// not make another program of it.
class PassLibrary {
 public:
  // They live as long as the library. @throws OpenGlError when a shader does not compile
  [[nodiscard]] PassPrograms programsFor(const PassFeatures& features);
  // One pass, "forces" for sim/forces.comp.
  [[nodiscard]] const gl::Program* find(const std::string& pass, const PassFeatures& features);

 private:
  std::map<std::pair<std::string, PassFeatures>, gl::Program> programs_;
};

}  // namespace clothsim
