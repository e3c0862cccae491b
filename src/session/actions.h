// Everything that a user can do to a running simulation. Actions are plain values: a recording stores each
// with the step before which it was applied, and a replay applies it again (session.h, recording.h). None
// depends on the camera.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "cloth/cuts.h"
#include "core/shared.h"
#include "scene/scene.h"

namespace clothsim {

// Changes the scene. Live fields take effect in the next step. Other fields rebuild the cloth: on the same
// lattice it keeps its state, pins and cuts; on another lattice it starts anew, and only the pins that the
// user has set are carried over, to the nearest points.
struct EditScene {
  Shared<Scene> scene;
};
// Pulls a particle by a spring to a point that the user moves. The spring is critically damped and stable at
// any strength. Particles within `radius` of it on the lattice at rest are pulled likewise and keep their
// formation; the farther away, the weaker. The point begins at the particle and moves to `target` over the
// next frame.
struct Grab {
  std::uint32_t particle = 0;
  Vec3d target;  // [m]
  // Stiffness of the spring over the particle's mass [1/s^2], > 0. The particle follows within about
  // 5 / sqrt(strength) seconds.
  double strength = 1e4;
  double radius = 0;  // [m], >= 0; 0: one particle
};
// Moves the point that pulls, linearly over the next frame.
struct MoveHand {
  Vec3d target;  // [m]
};
// Ends a Grab.
struct Release {};
// Pins a particle where it is now, or frees it. It leaves any path that the scene has for it.
struct SetPin {
  std::uint32_t particle = 0;
  bool pinned = true;
};
// Cuts a cloth along a line of its lattice, as cutAlong() in cloth/cuts.h does.
struct CutStroke {
  std::size_t piece = 0;
  LatticePoint from, to;
};
// A jet of air that lasts until the next Blow. In a scene without wind, drag acts only within the jet.
struct Blow {
  Vec3d origin, direction;  // [m], any length but 0
  double speed = 0;         // on the axis [m/s], 0 to 1000; 0 ends the jet
  double radius = 0.1;      // of the jet [m], > 0; the air outside is at rest
};
// Moves a collider linearly over the next frame; friction sees its velocity. A collider with a path of its
// own leaves the path during that frame; afterwards the whole path is shifted by the same vector.
struct MoveCollider {
  std::size_t collider = 0;  // in scene.colliders
  Vec3d position;            // of its origin or point [m]
};
// Turns a collider about its origin or point at a steady rate over the next frame; friction sees it. Turns of
// the same frame follow each other. A collider with a path of its own goes on along it, turned by as much.
struct TurnCollider {
  std::size_t collider = 0;  // in scene.colliders
  Vec3d turn;                // rotation vector, axis times angle, at most 180 long [degrees]
};
struct SwitchBackend {
  std::string backend;  // "cpu" or "gpu"
};
// Back to the start of the scene. Cuts, the Grab, the jet and the pins that the user has set are gone.
struct Restart {};

using Action = std::variant<EditScene, Grab, MoveHand, Release, SetPin, CutStroke, Blow, MoveCollider,
                            TurnCollider, SwitchBackend, Restart>;

}  // namespace clothsim
