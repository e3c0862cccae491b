// Where a collider or a motion is at a given time: evaluated on the host in double and handed to both
// backends and the renderer.
#pragma once

#include "scene/rotation.h"
#include "scene/scene.h"

namespace clothsim {

struct Pose {
  Vec3d position;  // the sphere's centre, the plane's point [m]
  Matrix3 rotation = identityMatrix;
};

// The rotation by which a shape's own frame stands in the world, before any motion. Round shapes have their
// axis along y there, planes their normal, boxes their edges along the axes.
[[nodiscard]] Matrix3 ownRotation(const Collider& collider);

// The time on the path of a motion at time t: within its keys, where it loops [s].
[[nodiscard]] double timeOnPath(const Motion& motion, double t);

// The key of a motion, which has at least one, at time t [s]: between those given straight or smooth, as the
// motion's `interpolation` says.
[[nodiscard]] Motion::Key keyAt(const Motion& motion, double t);

// The pose at time t [s]; without a motion the collider's own place, unrotated.
[[nodiscard]] Pose poseAt(const Collider& collider, double t);
// The pose of a motion that has at least one key.
[[nodiscard]] Pose poseAt(const Motion& motion, double t);

}  // namespace clothsim
