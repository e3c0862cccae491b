#include "solver/pin_paths.h"

#include <array>
#include <cmath>
#include <utility>

#include "cloth/pins.h"
#include "scene/pose.h"

namespace clothsim {

namespace {

// The triangle as a frame about the spot, in the world.
Pose poseOf(const Collider& body, const SurfaceSpot& spot, double time) {
  const auto& mesh = std::get<MeshCollider>(body);
  const ShapeMoment moment = mesh.momentAt(mesh.progressAt(time));
  const std::vector<SolidMesh>& shapes = spot.grid->shapes();
  const SolidMesh::Triangle& triangle = shapes.front().triangles[spot.point.triangle];
  std::array<Vec3d, 3> corners;
  Vec3d place;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d from = shapes[moment.from].points[triangle[k]], to = shapes[moment.to].points[triangle[k]];
    corners[k] = from + moment.part * (to - from);
    place = place + spot.point.weights[k] * corners[k];
  }
  const Vec3d along = unitVector(corners[1] - corners[0]),
              normal = unitVector(cross(corners[1] - corners[0], corners[2] - corners[0]));
  const Pose now = poseAt(body, time);
  const Matrix3 own = product(now.rotation, ownRotation(body));
  return {now.position + rotate(own, place), product(own, transposed({along, normal, cross(along, normal)}))};
}

// A path for each pin of the path `number`, which follows a body that deforms.
void addSpots(const Cloth& cloth, std::size_t number, PinPaths& paths) {
  const PinPath whole = paths.paths[number];
  const Collider& body = *whole.body;
  const auto grid = distanceGridOf(std::get<MeshCollider>(body));
  const Pose start = poseAt(body, 0);
  const Matrix3 own = product(start.rotation, ownRotation(body));
  const auto& mesh = std::get<MeshCollider>(body);
  const auto shape = grid->at(mesh.momentAt(mesh.progressAt(0)));
  for (std::size_t i = 0; i < paths.numbers.size(); ++i) {
    if (paths.numbers[i] != number + 1) continue;
    PinPath single = whole;
    single.center = cloth.positions()[i];
    const Vec3d place = rotateBack(own, single.center - start.position);
    single.spot = std::make_shared<const SurfaceSpot>(SurfaceSpot{grid, shape->tree.nearestPoint(place)});
    paths.paths.push_back(std::move(single));
    paths.numbers[i] = static_cast<std::uint32_t>(paths.paths.size());
  }
}

}  // namespace

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
  for (std::size_t path = result.paths.size(); path-- > 0;)
    if (result.paths[path].body && deforms(*result.paths[path].body)) addSpots(cloth, path, result);
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
  const auto pose = [&](double t) {
    return path.spot ? poseOf(*path.body, *path.spot, t) : poseAt(*path.body, t);
  };
  const Pose first = pose(0), now = pose(time);
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
