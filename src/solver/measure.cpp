#include "solver/measure.h"

#include <algorithm>
#include <cmath>

#include "scene/pose.h"

namespace clothsim {
namespace {

Vec3d positionOf(const State& state, std::size_t i) {
  const Particle4& x = state.positions[i];
  return Vec3f{x.x, x.y, x.z}.cast<double>();
}

double length(Vec3d v) { return std::sqrt(dot(v, v)); }

bool finite(const Particle4& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Of one grid; none without springs.
std::optional<double> maxStrain(const Cloth& cloth, const Grid& grid, const State& state) {
  double largest = -1;  // a spring of no length, the smallest that can be
#pragma omp parallel for reduction(max : largest)
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
        const SpringOffset& offset = springOffsets[slot];
        if (!grid.slotEnabled[slot] || !grid.contains(column + offset.columns, row + offset.rows)) continue;
        const std::uint32_t a = grid.particle(column, row);
        const std::uint32_t b = grid.particle(column + offset.columns, row + offset.rows);
        const double rest = grid.hasRestLengthTable ? length(cloth.positions()[b] - cloth.positions()[a])
                                                    : grid.nominalLength[slot];
        largest = std::max(largest, length(positionOf(state, b) - positionOf(state, a)) / rest - 1);
      }
    }
  }
  if (std::find(grid.slotEnabled.begin(), grid.slotEnabled.end(), true) == grid.slotEnabled.end())
    return std::nullopt;
  return largest;
}

double penetration(const Collider& collider, const Pose& pose, Vec3d start, Vec3d x) {
  if (const auto* sphere = std::get_if<Sphere>(&collider)) return sphere->radius - length(x - pose.position);
  const auto& plane = std::get<Plane>(collider);
  const Pose first = poseAt(collider, 0);
  const double side = dot(start - first.position, rotate(first.rotation, plane.normal)) < 0 ? -1 : 1;
  const Vec3d normal = rotate(pose.rotation, plane.normal);
  return -side * dot(x - pose.position, normal) / length(normal);
}

}  // namespace

Measures measure(const Cloth& cloth, const Scene& scene, const State& state) {
  Measures measures;
  const std::size_t count = state.positions.size();
  for (std::size_t i = 0; i < count && !measures.firstNonFinite; ++i)
    if (!finite(state.positions[i]) || !finite(state.velocities[i]))
      measures.firstNonFinite = static_cast<std::uint32_t>(i);

  measures.minY = positionOf(state, 0).y;
  for (std::size_t i = 0; i < count; ++i) {
    const Particle4& v = state.velocities[i];
    const Vec3d x = positionOf(state, i), velocity = Vec3f{v.x, v.y, v.z}.cast<double>();
    measures.minY = std::min(measures.minY, x.y);
    measures.centroid = measures.centroid + x;
    if (state.positions[i].w > 0)
      measures.kineticEnergy += 0.5 * dot(velocity, velocity) / static_cast<double>(state.positions[i].w);
  }
  measures.centroid = (1.0 / static_cast<double>(count)) * measures.centroid;

  std::optional<double> strain;
  for (const Grid& grid : cloth.grids())
    if (const auto ofGrid = maxStrain(cloth, grid, state))
      strain = std::max(strain.value_or(*ofGrid), *ofGrid);
  measures.maxStrain = strain.value_or(0);
  const double time = static_cast<double>(state.step) * stepLength(scene.solver);
  for (const Collider& collider : scene.colliders) {
    const Pose pose = poseAt(collider, time);
    for (std::size_t i = 0; i < count; ++i)
      if (state.positions[i].w > 0)
        measures.maxPenetration = std::max(
            measures.maxPenetration, penetration(collider, pose, cloth.positions()[i], positionOf(state, i)));
  }
  return measures;
}

}  // namespace clothsim
