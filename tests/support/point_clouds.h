// Positions for tests of contacts between particles.
#pragma once

#include "solver/cpu/cpu_state.h"
#include "support/test_scenes.h"

namespace clothsim::test {

inline Scene contactScene(int n, SelfCollision mode) {
  Scene scene = sheetScene(n);
  scene.solver.selfCollision = mode;
  scene.solver.strainLimit = 0.1;
  scene.cloths[0].thickness = 0.49 / (n - 1);
  return scene;
}

template <class Real = float>
Components<Real> cloud(std::size_t count) {
  Components<Real> points;
  points.resize(count);
  return points;
}

template <class Real>
Vec3d point(const Components<Real>& points, std::size_t i) {
  return Vec3<Real>{points.x[i], points.y[i], points.z[i]}.template cast<double>();
}

}  // namespace clothsim::test
