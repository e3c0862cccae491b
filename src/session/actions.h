// Everything that can be done to a running simulation by hand: plain values, so that they can be recorded
// with the step before which they acted, and acted again (session.h, recording.h). None depends on the
// camera.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "cloth/cuts.h"
#include "core/shared.h"
#include "scene/scene.h"

namespace clothsim {

// Parameters of the scene: live ones from the next step on. Others rebuild the cloth; it stays where it is,
// with its pins and cuts, unless it begins from another lattice: then it starts anew with the pins set by
// hand at their places.
struct EditScene {
  Shared<Scene> scene;
};
// A soft spring from a particle to the hand, critically damped, stable at any strength. Particles within
// `radius` of it on the lattice at rest follow in formation, ever softer with the distance. The hand begins
// at the particle and goes to `target` over the next frame.
struct Grab {
  std::uint32_t particle = 0;
  Vec3d target;  // [m]
  double strength =
      1e4;  // of the spring, per mass [1/s^2]: what is held follows within about 5 / sqrt(strength) s
  double radius = 0;  // [m], >= 0; 0 holds one particle
};
struct MoveHand {  // linearly over the next frame
  Vec3d target;    // [m]
};
struct Release {};
// The particle stays where it is now, off any path that the scene has for it; or gets its mass back.
struct SetPin {
  std::uint32_t particle = 0;
  bool pinned = true;
};
struct CutStroke {  // as cutAlong() of cloth/cuts.h
  std::size_t grid = 0;
  LatticePoint from, to;
};
// A jet of air, until the next Blow. Without wind in the scene, drag acts in the jet alone.
struct Blow {
  Vec3d origin, direction;  // [m], any length but 0
  double speed = 0;         // on the axis [m/s]; 0 ends it
  double radius = 0.1;      // beyond which the air rests [m], > 0
};
// Linearly over the next frame, at a velocity that friction feels; then it stays. A collider on a path of its
// own is off it during that frame; afterwards the whole path is shifted.
struct MoveCollider {
  std::size_t collider = 0;  // in scene.colliders
  Vec3d position;            // of its origin or point [m]
};
struct SwitchBackend {
  std::string backend;  // "cpu" or "gpu"
};
struct Restart {};  // from the start of the scene: without cuts, hands and pins set by hand

using Action = std::variant<EditScene, Grab, MoveHand, Release, SetPin, CutStroke, Blow, MoveCollider,
                            SwitchBackend, Restart>;

}  // namespace clothsim
