// Motions, and colliders that follow them.
#include "scene/pose.h"

#include <algorithm>
#include <cmath>

namespace clothsim {

namespace {

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
