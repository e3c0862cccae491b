// Motions, and colliders that follow them.
#include "scene/pose.h"

#include <algorithm>
#include <cmath>

namespace clothsim {

namespace {

struct Velocity {
  Vec3d position, rotation;  // [m/s], [degrees/s]
};

// From the key before to the key behind; a path that loops goes on from its last key with the second.
Velocity velocityAt(const Motion& motion, std::size_t key) {
  const auto& keys = motion.keys;
  const std::size_t last = keys.size() - 1;
  const bool isEnd = key == 0 || key == last;
  if (isEnd && !motion.loop) return {};
  const auto between = [&](std::size_t a, std::size_t b) {
    return Motion::Key{keys[b].t - keys[a].t, keys[b].position - keys[a].position,
                       keys[b].rotation - keys[a].rotation};
  };
  const Motion::Key before = isEnd ? between(last - 1, last) : between(key - 1, key);
  const Motion::Key behind = isEnd ? between(0, 1) : between(key, key + 1);
  const double rate = 1 / (before.t + behind.t);
  return {rate * (before.position + behind.position), rate * (before.rotation + behind.rotation)};
}

// From a to b with the derivatives u and v there, s from 0 to 1.
Vec3d hermite(double s, Vec3d a, Vec3d u, Vec3d b, Vec3d v) {
  const double r = 1 - s;
  return (r * r * (1 + 2 * s)) * a + (s * r * r) * u + (s * s * (3 - 2 * s)) * b - (s * s * r) * v;
}

double wrapped(double t, double period) {
  const double rest = std::fmod(t, period);
  return rest < 0 ? rest + period : rest;
}

}  // namespace

double timeOnPath(const Motion& motion, double t) {
  return motion.loop && motion.keys.back().t > 0 ? wrapped(t, motion.keys.back().t) : t;
}

Motion::Key keyAt(const Motion& motion, double time) {
  const auto& keys = motion.keys;
  const double t = timeOnPath(motion, time);
  const auto later = std::upper_bound(keys.begin(), keys.end(), t,
                                      [](double now, const Motion::Key& key) { return now < key.t; });
  if (later == keys.begin()) return keys.front();
  if (later == keys.end()) return keys.back();
  const Motion::Key& a = *(later - 1);
  const Motion::Key& b = *later;
  const double s = (t - a.t) / (b.t - a.t);
  if (motion.interpolation == Interpolation::cubic) {
    const auto place = static_cast<std::size_t>(later - keys.begin());
    const Velocity begin = velocityAt(motion, place - 1), end = velocityAt(motion, place);
    const double h = b.t - a.t;
    return {t, hermite(s, a.position, h * begin.position, b.position, h * end.position),
            hermite(s, a.rotation, h * begin.rotation, b.rotation, h * end.rotation)};
  }
  return {t, a.position + s * (b.position - a.position), a.rotation + s * (b.rotation - a.rotation)};
}

Matrix3 ownRotation(const Collider& collider) {
  return std::visit([](const auto& shape) { return shape.ownRotation(); }, collider);
}

Pose poseAt(const Collider& collider, double t) {
  return std::visit(
      [t](const auto& shape) {
        if (!shape.motion || shape.motion->keys.empty()) return Pose{shape.place()};
        return poseAt(*shape.motion, t);
      },
      collider);
}

Pose poseAt(const Motion& motion, double t) {
  const Motion::Key key = keyAt(motion, t);
  return {key.position, rotationMatrix(key.rotation)};
}

}  // namespace clothsim
