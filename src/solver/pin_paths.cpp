#include "solver/pin_paths.h"

#include <cmath>
#include <utility>

#include "cloth/pins.h"
#include "scene/pose.h"

namespace clothsim {

PinPaths makePinPaths(const Scene& scene, const Cloth& cloth, std::span<const std::uint32_t> offPath) {
  PinPaths result;
  if (!hasPinMotion(scene)) return result;
  result.numbers.resize(cloth.particleCount());
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const ClothSettings& settings = scene.cloths[i];
    if (settings.pinMotion.empty()) continue;
    const std::size_t firstPath = result.paths.size(), firstParticle = cloth.pieces()[i].firstParticle;
    std::vector<Vec3d> sums(settings.pinMotion.size());
    std::vector<double> counts(settings.pinMotion.size());
    const std::vector<int> motions = pinMotionOfPoints(settings);
    for (std::size_t point = 0; point < motions.size(); ++point) {
      if (motions[point] == NO_MOTION) continue;
      const auto motion = static_cast<std::size_t>(motions[point]);
      result.numbers[firstParticle + point] = static_cast<std::uint32_t>(firstPath + motion + 1);
      sums[motion] = sums[motion] + cloth.positions()[firstParticle + point];
      ++counts[motion];
    }
    for (std::size_t k = 0; k < settings.pinMotion.size(); ++k) {
      PinPath path;
      if (counts[k] > 0) path.center = (1 / counts[k]) * sums[k];
      path.motion = pathAbout(settings.pinMotion[k], path.center);
      path.isFree = freeKeys(settings.pinMotion[k]);
      path.release = settings.pinMotion[k].release;
      if (const int body = settings.pinMotion[k].collider; body != NO_BODY)
        path.body = scene.colliders[static_cast<std::size_t>(body)];
      result.paths.push_back(std::move(path));
    }
  }
  for (const std::uint32_t particle : offPath) result.numbers[particle] = 0;
  return result;
}

bool isHeld(const PinPath& path, double time) {
  if (path.release && time >= *path.release) return false;
  if (path.isFree.empty()) return true;
  const double t = timeOnPath(path.motion, time);
  bool free = false;
  for (std::size_t i = 0; i < path.isFree.size() && path.motion.keys[i].t <= t; ++i) free = path.isFree[i];
  return !free;
}

namespace {

// Where the centre is, and how the pins are turned about it.
Pose poseOf(const PinPath& path, double time) {
  if (!path.body) return poseAt(path.motion, time);
  const Pose first = poseAt(*path.body, 0), now = poseAt(*path.body, time);
  const Matrix3 turn = product(now.rotation, transposed(first.rotation));
  return {now.position + rotate(turn, path.center - first.position), turn};
}

}  // namespace

template <class Real>
PinMotionParams<Real> makePinMotionParams(const PinPath& path, double time, double h) {
  const Pose pose = poseOf(path, time);
  const auto& [rowX, rowY, rowZ] = pose.rotation;
  const Vec3d translation = pose.position - path.center;
  const auto real = [](double x) { return static_cast<Real>(x); };
  PinMotionParams<Real> params{};
  params.rotationXX = real(rowX.x - 1);
  params.rotationXY = real(rowX.y);
  params.rotationXZ = real(rowX.z);
  params.translationX = real(translation.x);
  params.rotationYX = real(rowY.x);
  params.rotationYY = real(rowY.y - 1);
  params.rotationYZ = real(rowY.z);
  params.translationY = real(translation.y);
  params.rotationZX = real(rowZ.x);
  params.rotationZY = real(rowZ.y);
  params.rotationZZ = real(rowZ.z - 1);
  params.translationZ = real(translation.z);
  params.pivotX = real(path.center.x);
  params.pivotY = real(path.center.y);
  params.pivotZ = real(path.center.z);
  if (!path.isFree.empty()) {
    params.follow = real(1 - std::exp(-h / HAND_TIME));
    params.reach = real(h * HAND_SPEED);
    params.reachSquared = real(h * HAND_SPEED * h * HAND_SPEED);
  }
  return params;
}

template PinMotionParams<float> makePinMotionParams(const PinPath&, double, double);
template PinMotionParams<double> makePinMotionParams(const PinPath&, double, double);

}  // namespace clothsim
