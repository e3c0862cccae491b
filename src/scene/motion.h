// How a collider moves in time.
#pragma once

#include <vector>

#include "core/vec.h"

namespace clothsim {

// Between two keys: on a straight line at a steady speed, or on a cubic whose velocity at a key is the mean
// one from the key before to the key behind it, and 0 at the ends of a path that does not loop (E. Catmull
// and R. Rom, "A class of local interpolating splines", 1974).
enum class Interpolation { linear, cubic };

// A path of keys. Before the first key and after the last the pose stands still, unless
// `loop`.
struct Motion {
  struct Key {
    double t = 0;    // [s], ascending
    Vec3d position;  // [m], replaces the collider's origin or point
    Vec3d rotation;  // rotation vector, axis times angle [degrees]; interpolated as it is, so it may turn
                     // many times
    friend bool operator==(const Key&, const Key&) = default;
  };
  std::vector<Key> keys;
  bool loop = false;
  Interpolation interpolation = Interpolation::linear;
  friend bool operator==(const Motion&, const Motion&) = default;
};

}  // namespace clothsim
