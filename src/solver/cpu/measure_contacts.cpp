#include "solver/cpu/measure_contacts.h"

#include <algorithm>
#include <cmath>

#include "solver/cpu/self_collision.h"

namespace clothsim {
namespace {

constexpr double CONTACT_REACH = 1.05;  // pairs are at d or a little more once they have been parted

Vec3d vectorOf(const Particle4& p) { return Vec3f{p.x, p.y, p.z}.cast<double>(); }

const Grid& gridOf(const Cloth& cloth, std::uint32_t particle) {
  return *std::find_if(cloth.grids().begin(), cloth.grids().end(), [&](const Grid& grid) {
    return particle - grid.firstParticle < grid.particleCount();
  });
}

// Particles of one grid: how far apart they lie at rest, unless they share a cell. Of two grids: infinity.
std::optional<double> restDistance(const Grid& grid, std::uint32_t i, std::uint32_t j) {
  if (j - grid.firstParticle >= grid.particleCount()) return INFINITY;
  const auto columns = static_cast<std::int64_t>(grid.columns);
  const std::int64_t a = i - grid.firstParticle, b = j - grid.firstParticle;
  const std::int64_t across = std::abs(a % columns - b % columns),
                     along = std::abs(a / columns - b / columns);
  if (across <= 1 && along <= 1) return std::nullopt;
  return std::hypot(static_cast<double>(across) * grid.nominalLength[toLeft],
                    static_cast<double>(along) * grid.nominalLength[toUpper]);
}

}  // namespace

ContactMeasures measureContacts(const Cloth& cloth, const Scene& scene, const State& state, double stretch) {
  ContactMeasures measures;
  if (!collidesWithItself(scene, cloth)) return measures;
  const double d = contactDistance(scene, cloth), h = stepLength(scene.solver);
  measures.neededDistance = crossingDistance(cloth, std::max(stretch, 0.0));

  Components<float> positions;
  positions.resize(state.positions.size());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    positions.x[i] = state.positions[i].x;
    positions.y[i] = state.positions[i].y;
    positions.z[i] = state.positions[i].z;
  }
  cpu::SelfCollision<float> search(cloth, true);
  search.configure(scene);
  for (const auto& [i, j] : search.candidatePairs(positions)) {
    if (j < i) continue;
    const std::optional<double> rest = restDistance(gridOf(cloth, i), i, j);
    if (!rest) continue;
    const Vec3d apart = vectorOf(state.positions[i]) - vectorOf(state.positions[j]);
    const Vec3d relative = vectorOf(state.velocities[i]) - vectorOf(state.velocities[j]);
    const double distance = std::sqrt(dot(apart, apart));
    measures.contacts += distance < CONTACT_REACH * std::min(d, *rest);
    // A pair that lies nearer at rest than strangers may come has to keep that part of its distance.
    measures.overlaps += distance < measures.neededDistance * std::min(1.0, *rest / d);
    measures.smallestDistance = std::min(measures.smallestDistance.value_or(distance), distance);
    measures.relativeMotion = std::max(measures.relativeMotion, h * std::sqrt(dot(relative, relative)));
  }
  return measures;
}

}  // namespace clothsim
