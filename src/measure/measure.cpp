#include "measure/measure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cloth/seam_neighbours.h"
#include "core/thread_team.h"
#include "scene/colliders/collider_set.h"

namespace clothsim {
namespace {

Vec3d positionOf(const State& state, std::size_t i) {
  const Particle4& x = state.positions[i];
  return Vec3f{x.x, x.y, x.z}.cast<double>();
}

bool finite(const Particle4& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// The largest strain of one piece; none without springs.
std::optional<double> maxStrain(const Cloth& cloth, const Piece& piece, const State& state) {
  std::vector<double> largest(static_cast<std::size_t>(piece.rows), -1);  // -1: of a spring of length 0
  ThreadTeam::shared().forEach(
      0, static_cast<std::uint32_t>(piece.rows), rowsAtOnce(piece), [&](std::uint32_t r) {
        const int row = static_cast<int>(r);
        for (int column = 0; column < piece.columns; ++column) {
          for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
            const SpringOffset& offset = springOffsets[slot];
            if (!piece.slotEnabled[slot] || !piece.contains(column + offset.columns, row + offset.rows))
              continue;
            const std::uint32_t a = piece.particle(column, row);
            if (isCut(state.cuts, a, static_cast<SpringSlot>(slot))) continue;
            const std::uint32_t b = piece.particle(column + offset.columns, row + offset.rows);
            const double rest = cloth.restLength(piece, slot, a, b);
            largest[r] = std::max(largest[r], length(positionOf(state, b) - positionOf(state, a)) / rest - 1);
          }
        }
      });
  if (std::find(piece.slotEnabled.begin(), piece.slotEnabled.end(), true) == piece.slotEnabled.end())
    return std::nullopt;
  return *std::max_element(largest.begin(), largest.end());
}

// The largest strain of all meshes; none without springs.
std::optional<double> maxStrain(const Cloth& cloth, const std::vector<MeshSpring>& springs,
                                const State& state) {
  if (springs.empty()) return std::nullopt;
  double largest = -1;
  for (const MeshSpring& spring : springs) {
    if (isCut(state.cuts, cloth, spring)) continue;
    const double rest = cloth.restLength(cloth.pieces()[cloth.pieceOf(spring.a)], 0, spring.a, spring.b);
    largest = std::max(largest, length(positionOf(state, spring.b) - positionOf(state, spring.a)) / rest - 1);
  }
  return largest;
}

// A collider at one time.
class Solid {
 public:
  Solid(const ColliderSet& colliders, std::size_t number, const Scene& scene, double time)
      : colliders_(&colliders),
        number_(number),
        time_(time),
        now_(poseAt(colliders[number], time)),
        first_(poseAt(colliders[number], 0)),
        rotation_(colliders.rotationAt(number, time)),
        twoSided_(std::holds_alternative<Plane>(colliders[number]) &&
                  scene.solver.frictionLaw == FrictionLaw::cs184) {}

  // The depth of a particle at x that started at `start`. CS184's planes keep each particle on its side.
  [[nodiscard]] double penetration(Vec3d start, Vec3d x) const {
    const double depth = -colliders_->distance(number_, rotateBack(rotation_, x - now_.position), time_);
    return twoSided_ && startedBehind(start) ? -depth : depth;
  }

 private:
  [[nodiscard]] bool startedBehind(Vec3d start) const {
    return dot(start - first_.position,
               rotate(first_.rotation, std::get<Plane>((*colliders_)[number_]).normal)) < 0;
  }

  const ColliderSet* colliders_;
  std::size_t number_;
  double time_;
  Pose now_, first_;
  Matrix3 rotation_;
  bool twoSided_;
};

}  // namespace

SeamGap seamGap(const Cloth& cloth, const Scene& scene, const State& state, std::optional<double> settled) {
  SeamGap largest;
  const double time = state.clock.time();
  for (const SeamSpring& spring : cloth.seams()) {
    const Seam& seam = scene.seams[spring.seam];
    if (settled && time < seam.time + *settled) continue;
    const double left =
        seamLengthFactor(seam, time) * length(cloth.positions()[spring.b] - cloth.positions()[spring.a]);
    const double gap = length(positionOf(state, spring.b) - positionOf(state, spring.a)) - left;
    if (gap > largest.distance) largest = {gap, spring.seam, spring.stiffness};
  }
  return largest;
}

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

  std::optional<double> strain = maxStrain(cloth, cloth.lists().springs, state);
  for (const Piece& piece : cloth.pieces())
    if (const auto ofPiece = maxStrain(cloth, piece, state))
      strain = std::max(strain.value_or(*ofPiece), *ofPiece);
  measures.maxStrain = strain.value_or(0);
  const double time = state.clock.time();
  const ColliderSet colliders(scene);
  for (std::size_t number = 0; number < colliders.size(); ++number) {
    const Solid solid(colliders, number, scene, time);
    for (std::size_t i = 0; i < count; ++i)
      if (state.positions[i].w > 0)
        measures.maxPenetration =
            std::max(measures.maxPenetration, solid.penetration(cloth.positions()[i], positionOf(state, i)));
  }
  measures.seamGap = seamGap(cloth, scene, state).distance;
  return measures;
}

ColliderOverlaps overlapsWithColliders(const Cloth& cloth, const Scene& scene, const State& state) {
  constexpr double contactShare = 0.02;  // of the spacing: pushing a particle out so far is hardly visible
  constexpr double rounding = 1e-6;      // [m]
  const double fromContact = std::max(contactShare * smallestSpacing(cloth), rounding);
  std::vector<Solid> solids;
  const ColliderSet colliders(scene);
  for (std::size_t number = 0; number < colliders.size(); ++number)
    solids.emplace_back(colliders, number, scene, state.clock.time());
  ColliderOverlaps overlaps;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    if (state.positions[i].w == 0) continue;
    double depth = 0;
    for (const Solid& solid : solids)
      depth = std::max(depth, solid.penetration(cloth.positions()[i], positionOf(state, i)));
    overlaps.particles += depth > fromContact ? 1 : 0;
    overlaps.depth = std::max(overlaps.depth, depth);
  }
  return overlaps;
}

// Sorted along a direction in which no grid or plane is likely to have many particles side by side.
std::uint64_t coincidentPoints(const Cloth& cloth, const State& state) {
  constexpr double near = 1e-5;  // [m]
  const Vec3d direction{0.5377, 0.6124, 0.5796};
  const std::vector<std::uint32_t> joints = seamJoints(cloth);
  std::vector<std::pair<double, std::uint32_t>> places(state.positions.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) places[i] = {dot(direction, positionOf(state, i)), i};
  std::ranges::sort(places);
  std::vector<bool> coincides(places.size());
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = a + 1; b < places.size() && places[b].first - places[a].first <= near; ++b) {
      const std::uint32_t i = places[a].second, j = places[b].second;
      const Vec3d way = positionOf(state, i) - positionOf(state, j);
      if (!(dot(way, way) <= near * near) || joints[i] == joints[j]) continue;
      coincides[a] = coincides[b] = true;
      break;  // a heap of points at one place is walked through once
    }
  return static_cast<std::uint64_t>(std::ranges::count(coincides, true));
}

}  // namespace clothsim
