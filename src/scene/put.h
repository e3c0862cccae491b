// Stores what was evaluated in double, rounded once.
#pragma once

namespace clothsim {

template <class Real>
void put(Real& to, double value) {
  to = static_cast<Real>(value);
}

}  // namespace clothsim
