#include "scene/colliders/collider_set.h"

#include <mutex>
#include <type_traits>
#include <utility>

#include "scene/colliders/sampled_mesh.h"

namespace clothsim {
namespace {

// The shape's own axes are the columns of its rotation.
template <class Real>
void putAxes(const Matrix3& rotation, ColliderParams<Real>& params) {
  put(params.axisXX, rotation[0].x);
  put(params.axisXY, rotation[1].x);
  put(params.axisXZ, rotation[2].x);
  put(params.axisYX, rotation[0].y);
  put(params.axisYY, rotation[1].y);
  put(params.axisYZ, rotation[2].y);
  put(params.axisZX, rotation[0].z);
  put(params.axisZY, rotation[1].z);
  put(params.axisZZ, rotation[2].z);
}

// rotation = R(after) R(before)^T - 1, translation = position(after) - position(before)
template <class Real>
void putMotion(const Pose& before, const Pose& after, ColliderParams<Real>& params) {
  params.moving = 1;
  const Vec3d columnX = rotate(after.rotation, rotateBack(before.rotation, {1, 0, 0}));
  const Vec3d columnY = rotate(after.rotation, rotateBack(before.rotation, {0, 1, 0}));
  const Vec3d columnZ = rotate(after.rotation, rotateBack(before.rotation, {0, 0, 1}));
  const Vec3d translation = after.position - before.position;
  put(params.rotationXX, columnX.x - 1);
  put(params.rotationXY, columnY.x);
  put(params.rotationXZ, columnZ.x);
  put(params.translationX, translation.x);
  put(params.rotationYX, columnX.y);
  put(params.rotationYY, columnY.y - 1);
  put(params.rotationYZ, columnZ.y);
  put(params.translationY, translation.y);
  put(params.rotationZX, columnX.z);
  put(params.rotationZY, columnY.z);
  put(params.rotationZZ, columnZ.z - 1);
  put(params.translationZ, translation.z);
  put(params.pivotX, before.position.x);
  put(params.pivotY, before.position.y);
  put(params.pivotZ, before.position.z);
}

template <class Real>
void packWays(const MeshCollider& body, const SampledMesh& mesh, double begin, double end,
              ColliderParams<Real>& params) {
  const double middle = 0.5 * (begin + end);
  mesh.packWays(params, body.momentAt(body.progressAt(middle)),
                body.progressAt(end) - body.progressAt(begin));
}

// The samples of the grids, one after the other, and the grids that they are from.
struct Samples {
  DistanceGrids grids;
  std::vector<float> values;
};

// Sets with the same grids share one list: measuring makes a set in every frame. `firsts`: by grid.
std::shared_ptr<const std::vector<float>> samplesOf(const DistanceGrids& grids,
                                                    std::vector<std::size_t>& firsts) {
  static std::mutex mutex;
  static std::weak_ptr<const Samples> last;
  std::size_t count = 0;
  for (const auto& grid : grids) {
    firsts.push_back(count);
    count += grid ? grid->samples().size() : 0;
  }
  const std::lock_guard lock(mutex);
  std::shared_ptr<const Samples> shared = last.lock();
  if (!shared || shared->grids != grids) {
    Samples made{grids, {}};
    made.values.reserve(count);
    for (const auto& grid : grids)
      if (grid) made.values.insert(made.values.end(), grid->samples().begin(), grid->samples().end());
    last = shared = std::make_shared<const Samples>(std::move(made));
  }
  return {shared, &shared->values};
}

}  // namespace

ColliderSet::ColliderSet(const Scene& scene, std::size_t mostSamples)
    : colliders_(scene.colliders),
      grids_(distanceGridsOf(scene.colliders, mostSamples)),
      coulomb_(scene.solver.frictionLaw == FrictionLaw::coulomb) {
  distances_ = samplesOf(grids_, firstSamples_);
}

// Calls `use` with the shape, or with a mesh at `time` that has its samples.
template <class Use>
decltype(auto) ColliderSet::withSolid(std::size_t i, double time, Use use) const {
  return std::visit(
      [&](const auto& shape) {
        using Shape = std::remove_cvref_t<decltype(shape)>;
        if constexpr (std::is_same_v<Shape, MeshCollider>) {
          return use(SampledMesh{*grids_[i], firstSamples_[i], shape.momentAt(shape.progressAt(time))});
        } else {
          static_assert(SolidShape<Shape, ColliderParams<float>>);
          return use(shape);
        }
      },
      colliders_[i]);
}

template <class Real>
ColliderParams<Real> ColliderSet::params(std::size_t i, double begin, double end) const {
  const Collider& collider = colliders_[i];
  const Pose before = poseAt(collider, begin);
  const Pose after = poseAt(collider, end);
  ColliderParams<Real> params{};
  put(params.pointX, after.position.x);
  put(params.pointY, after.position.y);
  put(params.pointZ, after.position.z);
  put(params.friction, std::visit([](const auto& shape) { return shape.friction; }, collider));
  params.coulomb = coulomb_ ? 1 : 0;
  params.type = static_cast<std::uint32_t>(collider.index());
  withSolid(i, end, [&](const auto& solid) {
    solid.pack(params, after.rotation);
    if constexpr (requires { solid.grid; })
      if (deforms(collider)) packWays(std::get<MeshCollider>(collider), solid, begin, end, params);
  });
  putAxes(product(after.rotation, clothsim::ownRotation(collider)), params);
  if (moves(collider)) putMotion(before, after, params);
  return params;
}

Matrix3 ColliderSet::rotationAt(std::size_t i, double time) const {
  return product(poseAt(colliders_[i], time).rotation, ownRotation(colliders_[i]));
}

double ColliderSet::distance(std::size_t i, Vec3d p, double time) const {
  return withSolid(i, time, [&](const auto& solid) { return solid.distance(p); });
}

Surface ColliderSet::drawnSurface(std::size_t i, double longestEdge, double time) const {
  return withSolid(i, time, [&](const auto& solid) { return solid.surface(longestEdge); });
}

Vec3d ColliderSet::halfExtent(std::size_t i, const Matrix3& motion) const {
  const Matrix3 rotation = product(motion, ownRotation(colliders_[i]));
  return withSolid(i, 0, [&](const auto& solid) { return solid.halfExtent(rotation); });
}

template ColliderParams<float> ColliderSet::params(std::size_t, double, double) const;
template ColliderParams<double> ColliderSet::params(std::size_t, double, double) const;

}  // namespace clothsim
