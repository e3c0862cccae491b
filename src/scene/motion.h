// How a collider moves in time.
#pragma once

#include <vector>

#include "core/vec.h"

namespace clothsim {

// A path of keys, linear in between. Before the first key and after the last the pose stands still, unless
// `loop`.
struct Motion {
  struct Key {
    double t = 0;    // [s], ascending
    Vec3d position;  // [m], replaces the collider's origin or point
    Vec3d rotation;  // rotation vector, axis times angle [degrees]; linear between keys, so it may turn many
                     // times
    friend bool operator==(const Key&, const Key&) = default;
  };
  std::vector<Key> keys;
  bool loop = false;
  friend bool operator==(const Motion&, const Motion&) = default;
};

}  // namespace clothsim
