// The motion of a rigid body that particles come nearest to. It keeps distances: what has to be looked for
// again is what moves in another way.
#pragma once

#include "core/vec.h"
#include "solver/cpu/arrays.h"

namespace clothsim::cpu {

// From where particles were to where the motion takes them: x goes to movedCenter + R (x - center).
template <class Real>
struct RigidMap {
  Vec3<Real> rows[3];  // of R
  Vec3<Real> center, movedCenter;
};

class RigidMotion {
 public:
  RigidMotion() = default;
  // Of least squares over a sample of the particles, which count alike: their mean velocity, and the angular
  // velocity with their angular momentum.
  template <class Real>
  RigidMotion(const Components<Real>& positions, const Components<Real>& velocities);

  // Where it leads in `time` [s].
  template <class Real>
  [[nodiscard]] RigidMap<Real> after(double time) const;

 private:
  Vec3d center_, velocity_, angularVelocity_;  // [m], [m/s], [1/s]
};

}  // namespace clothsim::cpu
