// From rotations back to what the user writes.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/rotation.h"

namespace clothsim {

// The rotation vector of a rotation, axis times angle, 0 to 180 degrees long: the inverse of
// rotationMatrix(). By the quaternion (w, v) whose largest component is found first, which stays exact near
// 180 degrees (S. W. Shepperd, "Quaternion from rotation matrix", 1978).
[[nodiscard]] inline Vec3d rotationVector(const Matrix3& r) {
  const double xx = r[0].x, yy = r[1].y, zz = r[2].z, trace = xx + yy + zz;
  double w = 0;
  Vec3d v;
  if (trace >= std::max({xx, yy, zz})) {
    w = 1 + trace;
    v = {r[2].y - r[1].z, r[0].z - r[2].x, r[1].x - r[0].y};
  } else if (xx >= yy && xx >= zz) {
    w = r[2].y - r[1].z;
    v = {1 + xx - yy - zz, r[0].y + r[1].x, r[0].z + r[2].x};
  } else if (yy >= zz) {
    w = r[0].z - r[2].x;
    v = {r[0].y + r[1].x, 1 + yy - xx - zz, r[1].z + r[2].y};
  } else {
    w = r[1].x - r[0].y;
    v = {r[0].z + r[2].x, r[1].z + r[2].y, 1 + zz - xx - yy};
  }
  const double sine = length(v);
  if (sine == 0) return {};
  if (w < 0) {
    w = -w;
    v = -1.0 * v;
  }
  return (2 * std::atan2(sine, w) * 180 / std::numbers::pi / sine) * v;
}

}  // namespace clothsim
