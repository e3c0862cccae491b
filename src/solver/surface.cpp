#include "solver/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "cloth/seam_neighbours.h"
#include "shared/implicit.h"
#include "solver/self_collision.h"

namespace clothsim {
namespace {

// Room at the start, which grows, and how far.
constexpr std::uint32_t PAIRS_A_PARTICLE = 8, COLLIDERS_A_TRIANGLE = 4, LEAST_ROOM = 1024;
constexpr std::uint64_t MOST_PAIRS_A_PARTICLE = 256, MOST_PAIRS = 1u << 30;

// In the largest correction.
constexpr double QUANTA = 0x1p20;

// A step may bring parts nearer than predicted, by this acceleration times its square; pairs are looked for
// so far, but at most a quarter of a cell. With a quarter in short steps, too, all layers of a pile would be
// pairs.
constexpr double UNFORESEEN_ACCELERATION = 150;  // [m/s^2]

constexpr std::uint32_t NO_TRIANGLE = 0xffffffffu;

using Corners = std::array<std::uint32_t, 3>;

// A number of 10 bits with two zeros behind each.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

// Where along the curve of Morton (1966) a triangle lies, in the box of its piece.
class Curve {
 public:
  Curve(const Cloth& cloth, const Piece& piece) : cloth_(&cloth) {
    const auto all = cloth.positions().subspan(piece.firstParticle, piece.particleCount());
    low_ = all[0];
    Vec3d high = low_;
    for (const Vec3d& x : all) {
      low_ = {std::min(low_.x, x.x), std::min(low_.y, x.y), std::min(low_.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    size_ = std::max({high.x - low_.x, high.y - low_.y, high.z - low_.z, 1e-9});
  }
  [[nodiscard]] std::uint32_t placeOf(const Corners& t) const {
    const auto x = cloth_->positions();
    const Vec3d center = (1.0 / 3) * (x[t[0]] + x[t[1]] + x[t[2]]) - low_;
    const auto cell = [&](double c) {
      return static_cast<std::uint32_t>(std::clamp(1023 * c / size_, 0.0, 1023.0));
    };
    return spread(cell(center.x)) | spread(cell(center.y)) << 1 | spread(cell(center.z)) << 2;
  }

 private:
  const Cloth* cloth_;
  Vec3d low_;
  double size_;
};

std::vector<Corners> sortedTriangles(const Cloth& cloth, const Cuts& cuts) {
  std::vector<Curve> curves;
  for (const Piece& piece : cloth.pieces()) curves.emplace_back(cloth, piece);
  struct Placed {
    std::uint64_t place;
    Corners corners;
  };
  std::vector<Placed> placed;
  for (const Corners& corners : remainingTriangles(cloth, cuts)) {
    const std::size_t piece = cloth.pieceOf(corners[0]);
    placed.push_back({std::uint64_t{piece} << 32 | curves[piece].placeOf(corners), corners});
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.place < b.place; });
  std::vector<Corners> corners;
  for (const Placed& each : placed) corners.push_back(each.corners);
  return corners;
}

// The sides of all triangles, by their particles, in ascending order.
class Sides {
 public:
  explicit Sides(const std::vector<Corners>& triangles) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) sides_.push_back({particlesOf(triangles[i], k), i});
    std::sort(sides_.begin(), sides_.end());
  }
  // The triangles that have the side from corner k on: two of them at most, ascending.
  [[nodiscard]] std::vector<std::uint32_t> trianglesAt(const Corners& triangle, std::size_t k) const {
    const Particles side = particlesOf(triangle, k);
    std::vector<std::uint32_t> found;
    for (auto at = std::lower_bound(sides_.begin(), sides_.end(), std::pair{side, 0u});
         at != sides_.end() && at->first == side; ++at)
      found.push_back(at->second);
    return found;
  }

 private:
  using Particles = std::pair<std::uint32_t, std::uint32_t>;
  static Particles particlesOf(const Corners& t, std::size_t k) { return std::minmax(t[k], t[(k + 1) % 3]); }
  std::vector<std::pair<Particles, std::uint32_t>> sides_;
};

// What the triangles at a particle are to it.
struct Fan {
  std::uint32_t first = NO_TRIANGLE, count = 0;
  double shortestSide = INFINITY;  // [m]
};

std::vector<Fan> makeFans(const Cloth& cloth, const std::vector<Corners>& triangles) {
  std::vector<Fan> fans(cloth.particleCount());
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      const double length = clothsim::length(cloth.positions()[a] - cloth.positions()[b]);
      fans[a].first = std::min(fans[a].first, i);
      ++fans[a].count;
      for (const std::uint32_t end : {a, b})
        fans[end].shortestSide = std::min(fans[end].shortestSide, length);
    }
  return fans;
}

std::vector<std::uint32_t> makeRings(const std::vector<Corners>& triangles, std::uint32_t particles) {
  std::vector<std::vector<std::uint32_t>> around(particles);
  for (const Corners& corners : triangles)
    for (const std::uint32_t corner : corners)
      for (const std::uint32_t other : corners)
        if (other != corner && std::ranges::find(around[corner], other) == around[corner].end())
          around[corner].push_back(other);
  std::vector<std::uint32_t> rings;
  auto end = particles + 1;
  for (const auto& ring : around)
    rings.push_back(std::exchange(end, end + static_cast<std::uint32_t>(ring.size())));
  rings.push_back(end);
  for (const auto& ring : around) rings.insert(rings.end(), ring.begin(), ring.end());
  return rings;
}

SurfaceTriangle makeTriangle(std::uint32_t number, const std::vector<Corners>& triangles,
                             const std::vector<Fan>& fans, const Sides& sides) {
  const Corners& own = triangles[number];
  std::uint32_t owned = 0;
  std::array<std::uint32_t, 3> across{NO_PARTICLE, NO_PARTICLE, NO_PARTICLE};
  for (std::size_t k = 0; k < 3; ++k) {
    if (fans[own[k]].first == number) owned |= 1u << k;
    const std::vector<std::uint32_t> both = sides.trianglesAt(own, k);
    if (both[0] == number) owned |= 1u << (OWNED_SIDE + k);
    for (const std::uint32_t other : both)
      for (const std::uint32_t particle : triangles[other])
        if (other != number && particle != own[k] && particle != own[(k + 1) % 3]) across[k] = particle;
  }
  return {own[0], own[1], own[2], owned, across[0], across[1], across[2], NO_BLOCK};
}

// At most half the shortest side at the particle, or neighbours in the sheet would touch each other. [m]
double layerThickness(const ClothSettings& settings, const Fan& fan) {
  return std::min(settings.thicknessInUse(), fan.shortestSide / 2);
}

template <class Real>
SurfacePoint<Real> makePoint(const Cloth& cloth, const Scene& scene, std::uint32_t particle, const Fan& fan) {
  const std::size_t piece = cloth.pieceOf(particle);
  const ClothSettings& settings = scene.cloths[piece];
  constexpr double usualFriction = 0.3;
  const double radius = fan.count > 0 ? layerThickness(settings, fan) / 2 : 0,
               friction = scene.solver.selfFriction.value_or(settings.material ? settings.material->friction
                                                                               : usualFriction);
  return {static_cast<Real>(radius), static_cast<Real>(friction),
          static_cast<Real>(1.0 / std::max(fan.count, 1u)),
          static_cast<Real>(CONTACT_OVER_SPRINGS * cloth.pieces()[piece].stiffestSpring())};
}

// The blocks of a grid, row by row.
void addBlocks(const Piece& piece, std::vector<SurfaceBlock>& blocks) {
  const auto first = static_cast<std::uint32_t>(blocks.size());
  const auto inBlocks = [](int particles) {
    return static_cast<std::uint32_t>((particles + BLOCK_CELLS - 2) / BLOCK_CELLS);
  };
  const std::uint32_t columns = inBlocks(piece.columns), rows = inBlocks(piece.rows);
  const double along = piece.nominalLength[toLeft], down = piece.nominalLength[toUpper];
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const int left = static_cast<int>(column) * BLOCK_CELLS, top = static_cast<int>(row) * BLOCK_CELLS;
      blocks.push_back({piece.particle(left, top), static_cast<std::uint32_t>(piece.columns),
                        static_cast<std::uint32_t>(std::min(BLOCK_CELLS + 1, piece.columns - left)),
                        static_cast<std::uint32_t>(std::min(BLOCK_CELLS + 1, piece.rows - top)), column, row,
                        columns, rows, first, static_cast<float>(1 / along), static_cast<float>(1 / down),
                        static_cast<float>(along * down / std::hypot(along, down))});
    }
}

// The blocks of all grids. A cut would leave lines between places that are not in the grid.
template <class Real>
void findBlocks(const Cloth& cloth, const Cuts& cuts, ClothSurface<Real>& surface) {
  if (!cuts.empty()) return;
  std::vector<std::uint32_t> firstBlocks;
  for (const Piece& piece : cloth.pieces()) {
    firstBlocks.push_back(static_cast<std::uint32_t>(surface.blocks.size()));
    if (!piece.isMesh) addBlocks(piece, surface.blocks);
  }
  for (SurfaceTriangle& triangle : surface.triangles) {
    const std::size_t number = cloth.pieceOf(triangle.cornerA);
    const Piece& piece = cloth.pieces()[number];
    if (piece.isMesh) continue;
    const auto stride = static_cast<std::uint32_t>(piece.columns);
    std::uint32_t column = stride, row = static_cast<std::uint32_t>(piece.rows);
    for (const std::uint32_t corner : {triangle.cornerA, triangle.cornerB, triangle.cornerC}) {
      column = std::min(column, (corner - piece.firstParticle) % stride);
      row = std::min(row, (corner - piece.firstParticle) / stride);
    }
    const std::uint32_t first = firstBlocks[number];
    triangle.block = first + row / BLOCK_CELLS * surface.blocks[first].columns + column / BLOCK_CELLS;
  }
  surface.isOneGrid = cloth.pieces().size() == 1 && !surface.blocks.empty();
}

template <class Real>
void joinAtSeams(const Cloth& cloth, ClothSurface<Real>& surface) {
  surface.joints = seamJoints(cloth);
  std::vector<bool> isSewn(cloth.particleCount());
  for (const SeamSpring& spring : cloth.seams()) isSewn[spring.a] = isSewn[spring.b] = true;
  for (SurfaceTriangle& triangle : surface.triangles)
    if (isSewn[triangle.cornerA] || isSewn[triangle.cornerB] || isSewn[triangle.cornerC])
      triangle.owned |= 1u << IS_SEWN;
}

// A collider is small that is nowhere thicker than so many cells, to both sides of its middle, or that ends
// in such a tip.
constexpr double SMALL = 2;
// What is so many cells from a small collider or from its way counts as near.
constexpr double NEAR = 2;

// What of a collider triangles meet (shared::SmallCollider).
struct Core {
  double radius = INFINITY;        // how thick the collider is around it [m]
  Vec3d size{};                    // [m]
  std::optional<double> around{};  // the outer radius of a round one [m]
  double tip = radius;             // how thick it is at its thinner end [m]
};
Core coreOf(const Sphere& sphere) { return {sphere.radius}; }
Core coreOf(const Capsule& capsule) { return {capsule.radius, {0, capsule.length / 2, 0}}; }
Core coreOf(const Torus& torus) { return {torus.tubeRadius, {torus.radius, 0, torus.radius}, torus.radius}; }
Core coreOf(const Box& box) {
  const double radius = 0.5 * std::min({box.size.x, box.size.y, box.size.z});
  return {radius, 0.5 * box.size - Vec3d{radius, radius, radius}};
}
Core roundCore(double height, double outer) {
  const double radius = std::min(height / 2, outer), around = outer - radius;
  return {radius, {0, height / 2 - radius, 0}, around > 0 ? std::optional(around) : std::nullopt};
}
Core coreOf(const Cylinder& cylinder) { return roundCore(cylinder.height, cylinder.radius); }
Core coreOf(const Cone& cone) {
  Core core = roundCore(cone.height, std::max(cone.radius, cone.topRadius));
  core.tip = std::min({core.radius, cone.radius, cone.topRadius});
  return core;
}
Core coreOf(const Plane&) { return {}; }
Core coreOf(const MeshCollider&) { return {}; }  // not known

// The longest sides of the cells of any cloth.
double largestCell(const Cloth& cloth) {
  double largest = 0;
  for (const Piece& piece : cloth.pieces())
    largest = std::max({largest, piece.nominalLength[toLeft], piece.nominalLength[toUpper]});
  return largest;
}

template <class Real>
std::vector<SmallCollider<Real>> makeSmallColliders(const Scene& scene, double cell) {
  std::vector<SmallCollider<Real>> small;
  for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
    const Core core = std::visit([](const auto& shape) { return coreOf(shape); }, scene.colliders[i]);
    if (!(core.tip < SMALL * cell)) continue;
    // What is thick meets triangles at its tip alone.
    const bool isThick = !(core.radius < SMALL * cell);
    const double near = core.radius + NEAR * cell, around = core.around.value_or(0),
                 outerRadius = isThick ? -1 : around;
    const Vec3d size = isThick && core.around ? Vec3d{around, core.size.y, around} : core.size;
    const Vec3d extent = core.around ? Vec3d{around, core.size.y, around} : core.size;
    const auto real = [](double x) { return static_cast<Real>(x); };
    small.push_back({real(static_cast<double>(i)), real(length(extent) + near), real(core.radius), real(near),
                     real(size.x), real(size.y), real(size.z), real(outerRadius)});
  }
  return small;
}

}  // namespace

bool hasSurfaceContact(const Scene& scene) { return scene.solver.selfCollision == SelfCollision::contact; }
std::size_t smallColliders(const Scene& scene, const Cloth& cloth) {
  if (!isImplicit(scene.solver.integrator)) return 0;
  return makeSmallColliders<float>(scene, largestCell(cloth)).size();
}
std::size_t unseenColliders(const Scene& scene, const Cloth& cloth) {
  const double halfDiagonal = std::sqrt(0.5) * largestCell(cloth);
  std::size_t count = 0;
  for (const Collider& collider : scene.colliders) {
    const bool isSeen =
        isImplicit(scene.solver.integrator) && !std::holds_alternative<MeshCollider>(collider);
    const double thinness = std::visit([](const auto& shape) { return coreOf(shape).radius; }, collider);
    count += !isSeen && thinness < halfDiagonal ? 1 : 0;
  }
  return count;
}
ThinnedLayers thinnedLayers(const Scene& scene, const Cloth& cloth) {
  ThinnedLayers thinned;
  if (!hasSurfaceContact(scene)) return thinned;
  const std::vector<Fan> fans = makeFans(cloth, remainingTriangles(cloth, {}));
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const ClothSettings& settings = scene.cloths[cloth.pieceOf(i)];
    const double thickness = layerThickness(settings, fans[i]);
    if (thickness >= settings.thicknessInUse()) continue;
    ++thinned.particles;
    if (thickness < thinned.least) thinned.least = thickness, thinned.fabric = settings.thicknessInUse();
  }
  return thinned;
}
bool hasSurface(const Scene& scene, const Cloth& cloth) {
  return hasSurfaceContact(scene) || hasSmallColliders(scene, cloth);
}

template <class Real>
ClothSurface<Real> makeSurface(const Cloth& cloth, const Scene& scene, const Cuts& cuts) {
  ClothSurface<Real> surface;
  const std::vector<Corners> triangles = sortedTriangles(cloth, cuts);
  const std::vector<Fan> fans = makeFans(cloth, triangles);
  const Sides sides(triangles);
  const auto count = static_cast<std::uint32_t>(triangles.size());
  for (std::uint32_t i = 0; i < count; ++i)
    surface.triangles.push_back(makeTriangle(i, triangles, fans, sides));
  if (!cloth.seams().empty()) joinAtSeams(cloth, surface);
  surface.rings = makeRings(triangles, cloth.particleCount());
  double smallestRadius = INFINITY, largestRadius = 0, widest = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    surface.points.push_back(makePoint<Real>(cloth, scene, i, fans[i]));
    if (fans[i].count == 0) continue;
    const auto radius = static_cast<double>(surface.points.back().radius);
    smallestRadius = std::min(smallestRadius, radius);
    largestRadius = std::max(largestRadius, radius);
    widest = std::max(widest, fans[i].shortestSide);
  }
  if (count > 0) {
    constexpr double rounding = 0x1p-24;  // of places about 1 m from the origin, across a side
    const double h = stepLength(scene.solver);
    const double margin = std::min(widest / 4, UNFORESEEN_ACCELERATION * h * h);
    surface.margin = static_cast<Real>(static_cast<float>(margin));
    surface.largestPush = static_cast<Real>(widest / 4);
    surface.perQuantum = static_cast<Real>(static_cast<float>(QUANTA / surface.largestPush));
    surface.quantum = static_cast<Real>(static_cast<float>(surface.largestPush / QUANTA));
    surface.around = static_cast<Real>(largestRadius + margin / 2);
    surface.touchingReach = static_cast<Real>(static_cast<float>(1.01 * (2 * largestRadius + margin)));
    surface.leastGap = static_cast<Real>(
        std::min(std::max(0.1 * smallestRadius, std::sqrt(rounding * widest)), 0.5 * smallestRadius));
  }
  surface.touchesItself = hasSurfaceContact(scene);
  if (surface.touchesItself) findBlocks(cloth, cuts, surface);
  if (isImplicit(scene.solver.integrator))
    surface.colliders = makeSmallColliders<Real>(scene, largestCell(cloth));
  const auto particles = cloth.particleCount(),
             colliders = static_cast<std::uint32_t>(surface.colliders.size());
  if (surface.touchesItself) surface.roomForPairs = PAIRS_A_PARTICLE * particles;
  if (colliders > 0)
    surface.roomForPairs += std::max(std::min(colliders, COLLIDERS_A_TRIANGLE) * count, LEAST_ROOM);
  surface.pairLimit = static_cast<std::uint32_t>(
      std::min(MOST_PAIRS_A_PARTICLE * particles + surface.roomForPairs, MOST_PAIRS));
  surface.firstBoxes = {0};
  for (std::uint32_t boxes = count; boxes > 0;
       boxes = boxes == 1 ? 0 : (boxes + BOX_CHILDREN - 1) / BOX_CHILDREN)
    surface.firstBoxes.push_back(surface.firstBoxes.back() + boxes);
  return surface;
}

SurfaceState freshSurfaceState() {
  SurfaceState state{};
  state.leastGap = gapBits(INFINITY);
  return state;
}

void forgetCounts(SurfaceState& state) {
  state.mostPairs = state.shortened = state.guardedSteps = state.crowdedSteps = 0;
  state.pinLag = state.largestCorrection = state.passages = state.passageSteps = 0;
  state.leastGap = gapBits(INFINITY);
}

ContactCounts countsOf(const SurfaceState& state) {
  ContactCounts counts;
  counts.clampedSteps = state.guardedSteps;
  counts.pairs = state.mostPairs;
  counts.shortened = state.shortened;
  counts.crowdedSteps = state.crowdedSteps;
  counts.passages = state.passages;
  counts.passageSteps = state.passageSteps;
  counts.leastGap = static_cast<double>(std::bit_cast<float>(state.leastGap));
  counts.pinLag = static_cast<double>(std::bit_cast<float>(state.pinLag));
  counts.largestCorrection = static_cast<double>(std::bit_cast<float>(state.largestCorrection));
  return counts;
}

template ClothSurface<float> makeSurface(const Cloth&, const Scene&, const Cuts&);
template ClothSurface<double> makeSurface(const Cloth&, const Scene&, const Cuts&);

}  // namespace clothsim
