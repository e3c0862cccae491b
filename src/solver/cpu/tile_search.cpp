#include "solver/cpu/tile_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/thread_team.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

constexpr int TILE_SIDE = 4;  // of a grid's tile
constexpr std::uint32_t CHILDREN = 4, GROUPS_AT_ONCE = 16;

// Along the curve of Morton (1966), what follows each other lies together.
std::uint64_t spread(std::uint64_t x, int apart) {
  std::uint64_t bits = 0;
  for (int k = 0; k < 20; ++k) bits |= (x >> k & 1u) << (k * apart);
  return bits;
}
std::uint64_t placeOnCurve(std::uint64_t x, std::uint64_t y) { return spread(x, 2) | spread(y, 2) << 1; }
std::uint64_t placeOnCurve(Vec3d x, double cell) {
  const auto cells = [&](double c) { return static_cast<std::uint64_t>(c / cell); };
  return spread(cells(x.x), 3) | spread(cells(x.y), 3) << 1 | spread(cells(x.z), 3) << 2;
}

// The particles of a tile: positions, and places on the grid.
template <class Real>
struct TileView {
  const Real *x, *y, *z, *columns, *rows;
  const std::uint32_t* particles;
  std::uint32_t all;  // its particles, as bits
};

// Which of a tile's particles lie within the reach of a box.
template <class Real>
INLINE std::uint32_t nearBox(const Real* x, const Real* y, const Real* z, Vec3<Real> low, Vec3<Real> high,
                             Real reachSquared) {
  std::uint32_t near = 0;
#pragma omp simd reduction(| : near)
  for (std::uint32_t k = 0; k < TILE; ++k) {
    const Real dx = larger(larger(low.x - x[k], x[k] - high.x), Real(0)),
               dy = larger(larger(low.y - y[k], y[k] - high.y), Real(0)),
               dz = larger(larger(low.z - z[k], z[k] - high.z), Real(0));
    near |= (dx * dx + dy * dy) + dz * dz < reachSquared ? 1u << k : 0u;
  }
  return near;
}

// Which of them lie within the reach of a particle, and are not its neighbours.
template <class Real>
INLINE std::uint32_t nearParticle(const Real* x, const Real* y, const Real* z, const Real* columns,
                                  const Real* rows, Vec3<Real> place, Real column, Real row,
                                  Real reachSquared, Real neighborsSquared) {
  std::uint32_t near = 0;
#pragma omp simd reduction(| : near)
  for (std::uint32_t k = 0; k < TILE; ++k) {
    const Real dx = x[k] - place.x, dy = y[k] - place.y, dz = z[k] - place.z;
    const Real across = columns[k] - column, along = rows[k] - row;
    const Real distanceSquared = (dx * dx + dy * dy) + dz * dz;
    const Real counted = across * across + along * along > neighborsSquared ? distanceSquared : reachSquared;
    near |= counted < reachSquared ? 1u << k : 0u;
  }
  return near;
}

// Most particles of a tile nearby lie farther than the reach from the own tile's box.
template <class Real>
INLINE void findInTile(const TileView<Real>& own, const Bounds<Real>& box, const TileView<Real>& other,
                       Real reachSquared, Real neighborsSquared, std::vector<NearTile>& found) {
  std::uint32_t left =
      other.all & nearBox(other.x, other.y, other.z, threeOf(box.low), threeOf(box.high), reachSquared);
  for (; left != 0; left &= left - 1) {
    const auto j = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t near =
        own.all & nearParticle(own.x, own.y, own.z, own.columns, own.rows, load(other.x, other.y, other.z, j),
                               other.columns[j], other.rows[j], reachSquared, neighborsSquared);
    if (near != 0) found.push_back({other.particles[j], near});
  }
}

VECTOR_CLONES(void, findInFloatTile,
              (const TileView<float>& own, const Bounds<float>& box, const TileView<float>& other,
               float reachSquared, float neighborsSquared, std::vector<NearTile>& found),
              (own, box, other, reachSquared, neighborsSquared, found),
              findInTile(own, box, other, reachSquared, neighborsSquared, found))

}  // namespace

template <class Real>
TileSearch<Real>::TileSearch(const Cloth& cloth) {
  for (std::uint32_t number = 0; number < cloth.pieces().size(); ++number) {
    const Piece& piece = cloth.pieces()[number];
    piece.isMesh ? addMesh(cloth, piece, number) : addGrid(piece, number);
  }
  positions_.resize(particles_.size());
  firstGroups_ = {0};
  for (std::uint32_t boxes = tiles(); firstGroups_.size() == 1 || boxes > 1;) {
    boxes = (boxes + CHILDREN - 1) / CHILDREN;
    firstGroups_.push_back(firstGroups_.back() + boxes);
  }
  groups_.resize(firstGroups_.back());
}

template <class Real>
void TileSearch<Real>::addGrid(const Piece& piece, std::uint32_t number) {
  std::vector<std::pair<std::uint64_t, std::pair<int, int>>> places;
  for (int row = 0; row < piece.rows; row += TILE_SIDE)
    for (int column = 0; column < piece.columns; column += TILE_SIDE)
      places.push_back(
          {placeOnCurve(static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)), {column, row}});
  std::sort(places.begin(), places.end());
  for (const auto& [place, corner] : places) {
    std::vector<std::uint32_t> particles;
    for (int row = corner.second; row < std::min(corner.second + TILE_SIDE, piece.rows); ++row)
      for (int column = corner.first; column < std::min(corner.first + TILE_SIDE, piece.columns); ++column)
        particles.push_back(piece.firstParticle + static_cast<std::uint32_t>(row * piece.columns + column));
    addTile(particles, piece, number);
  }
}

template <class Real>
void TileSearch<Real>::addMesh(const Cloth& cloth, const Piece& piece, std::uint32_t number) {
  Vec3d low = cloth.positions()[piece.firstParticle];
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places;
  for (const bool isMeasured : {false, true})
    for (std::uint32_t i = piece.firstParticle; i < piece.firstParticle + piece.particleCount(); ++i) {
      const Vec3d x = cloth.positions()[i];
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      if (isMeasured) places.emplace_back(placeOnCurve(x - low, piece.longestEdge), i);
    }
  std::sort(places.begin(), places.end());
  std::vector<std::uint32_t> particles;
  for (const auto& [place, particle] : places) {
    particles.push_back(particle);
    if (particles.size() == TILE) addTile(std::exchange(particles, {}), piece, number);
  }
  if (!particles.empty()) addTile(particles, piece, number);
}

template <class Real>
void TileSearch<Real>::addTile(std::span<const std::uint32_t> particles, const Piece& piece,
                               std::uint32_t number) {
  tiles_.push_back({number, static_cast<std::uint32_t>(particles.size()), !piece.isMesh});
  for (std::size_t k = 0; k < TILE; ++k) {
    const std::uint32_t particle = particles[std::min(k, particles.size() - 1)];
    const auto place = static_cast<int>(particle - piece.firstParticle);
    particles_.push_back(particle);
    columns_.push_back(static_cast<Real>(place % piece.columns));
    rows_.push_back(static_cast<Real>(place / piece.columns));
  }
}

template <class Real>
void TileSearch<Real>::setPositions(const Components<Real>& positions) {
  const Arrays<const Real> from = arraysOf(positions);
  const Arrays<Real> to = arraysOf(positions_);
  ThreadTeam::shared().forEach(0, firstGroups_[1], GROUPS_AT_ONCE, [&](std::uint32_t group) {
    groups_[group] = {};
    for (std::uint32_t k = 0; k < std::min(CHILDREN, tiles() - CHILDREN * group); ++k) {
      const std::size_t first = std::size_t{CHILDREN * group + k} * TILE;
      Bounds<Real> box{fourAt(from, particles_[first]), fourAt(from, particles_[first])};
      for (std::size_t place = first; place < first + TILE; ++place) {
        const std::uint32_t particle = particles_[place];
        const Four<Real> x = fourAt(from, particle);
        put(to, static_cast<std::ptrdiff_t>(place), threeOf(x));
        box = joined(box, Bounds<Real>{x, x});
      }
      groups_[group].set(k, box);
    }
  });
  for (std::size_t level = 1; level + 1 < firstGroups_.size(); ++level)
    for (std::uint32_t group = firstGroups_[level]; group < firstGroups_[level + 1]; ++group) {
      const std::uint32_t below = firstGroups_[level - 1] + CHILDREN * (group - firstGroups_[level]);
      groups_[group] = {};
      for (std::uint32_t k = 0; k < std::min(CHILDREN, firstGroups_[level] - below); ++k)
        groups_[group].set(k, groups_[below + k].all());
    }
}

template <class Real>
void TileSearch<Real>::find(std::uint32_t tile, Real reachSquared, Real neighborsSquared,
                            std::vector<NearTile>& found) const {
  const auto viewOf = [&](std::uint32_t of) {
    const std::size_t first = std::size_t{of} * TILE;
    return TileView<Real>{
        &positions_.x[first], &positions_.y[first], &positions_.z[first],        &columns_[first],
        &rows_[first],        &particles_[first],   (1u << tiles_[of].count) - 1};
  };
  const Tile& own = tiles_[tile];
  const TileView<Real> ownView = viewOf(tile);
  const Bounds<Real> box = groups_[tile / CHILDREN].at(tile % CHILDREN);
  const Real reach = std::sqrt(reachSquared) * Real(1.0001);  // whatever is rounded on the way
  const Four<Real> around{reach, reach, reach, Real(0)};
  const Bounds<Real> wide{box.low - around, box.high + around};
  const auto look = [&](std::uint32_t other) {
    // Particles of different grids, or of a mesh, are no neighbours.
    const bool hasNeighbors = own.isGrid && tiles_[other].piece == own.piece;
    const Real neighbors = hasNeighbors ? neighborsSquared : Real(-1);
    if constexpr (std::is_same_v<Real, float>)
      findInFloatTile(ownView, box, viewOf(other), reachSquared, neighbors, found);
    else
      findInTile(ownView, box, viewOf(other), reachSquared, neighbors, found);
  };
  struct Place {
    std::size_t level;
    std::uint32_t group;
  };
  std::array<Place, 64> open;
  std::size_t count = 0;
  open[count++] = {firstGroups_.size() - 2, 0};
  while (count > 0) {
    const auto [level, group] = open[--count];
    const auto meets = overlap(groups_[firstGroups_[level] + group], wide);
    for (std::uint32_t k = 0; k < CHILDREN; ++k) {
      if (meets[k] == 0) continue;
      if (level == 0)
        look(CHILDREN * group + k);
      else
        open[count++] = {level - 1, CHILDREN * group + k};
    }
  }
}

template class TileSearch<float>;
template class TileSearch<double>;

}  // namespace clothsim::cpu
