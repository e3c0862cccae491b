// The CPU backend's particle state: one array per component, so that loops along a row run in vector
// registers.
#pragma once

#include <cstddef>
#include <vector>

namespace clothsim {

template <class Real>
struct Components {
  std::vector<Real> x, y, z;

  void resize(std::size_t size) {
    x.resize(size);
    y.resize(size);
    z.resize(size);
  }
};

template <class Real>
struct CpuState {
  Components<Real> positions;   // [m]
  Components<Real> velocities;  // [m/s]
};

}  // namespace clothsim
