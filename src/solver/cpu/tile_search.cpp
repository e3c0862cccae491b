#include "solver/cpu/tile_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/thread_team.h"
#include "core/vector_clones.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

constexpr int TILE_SIDE = 4;  // of a grid's tile
constexpr std::uint32_t GROUPS_AT_ONCE = 16;

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

// Which particles of the tile so many tiles to the right and below share a cell with each of a tile, or are
// it.
using Neighbors = std::array<std::uint32_t, TILE>;
constexpr Neighbors neighborsAt(int columns, int rows) {
  Neighbors result{};
  for (int k = 0; k < static_cast<int>(TILE); ++k)
    for (int j = 0; j < static_cast<int>(TILE); ++j) {
      const int across = TILE_SIDE * columns + j % TILE_SIDE - k % TILE_SIDE,
                along = TILE_SIDE * rows + j / TILE_SIDE - k / TILE_SIDE;
      if (across * across <= 1 && along * along <= 1) result[static_cast<std::size_t>(k)] |= 1u << j;
    }
  return result;
}
constexpr std::array<Neighbors, 9> NEIGHBORS{neighborsAt(-1, -1), neighborsAt(0, -1), neighborsAt(1, -1),
                                             neighborsAt(-1, 0),  neighborsAt(0, 0),  neighborsAt(1, 0),
                                             neighborsAt(-1, 1),  neighborsAt(0, 1),  neighborsAt(1, 1)};
constexpr Neighbors NONE{};
INLINE const Neighbors& neighborsOf(const Tile& own, const Tile& other) {
  const int columns = other.column - own.column, rows = other.row - own.row;
  if (!own.isOfGrid || other.piece != own.piece || columns * columns > 1 || rows * rows > 1) return NONE;
  const int place = 3 * (rows + 1) + columns + 1;
  return NEIGHBORS[static_cast<std::size_t>(place)];
}

// What is near the particles of a tile, of other tiles.
template <class Real>
INLINE void findNear(std::span<const Tile> tiles, const Arrays<const Real>& positions, std::uint32_t tile,
                     std::span<const std::uint32_t> others, Real reachSquared, bool neighbors,
                     std::vector<NearTile>& found) {
  using Vector = Sixteen<Real>;
  const auto sixteenAt = [](const Real* from) __attribute__((always_inline)) {
    Vector all;
    std::memcpy(&all, from, sizeof all);
    return all;
  };
  const std::size_t own = std::size_t{tile} * TILE;
  const Vector x = sixteenAt(positions.x + own), y = sixteenAt(positions.y + own),
               z = sixteenAt(positions.z + own);
  for (const std::uint32_t number : others) {
    const std::size_t first = std::size_t{number} * TILE;
    decltype(x < y) nearOf{};
#pragma GCC unroll 16
    for (std::uint32_t j = 0; j < TILE; ++j) {
      const Vector dx = x - positions.x[first + j], dy = y - positions.y[first + j],
                   dz = z - positions.z[first + j];
      nearOf |= ((dx * dx + dy * dy) + dz * dz < reachSquared) & (1 << j);
    }
    const Neighbors& leftOut = neighbors ? NONE : neighborsOf(tiles[tile], tiles[number]);
    NearTile near{number, {}};
    std::uint32_t any = 0;
    for (std::uint32_t k = 0; k < TILE; ++k) {
      near.near[k] = static_cast<std::uint32_t>(nearOf[k]) & ~leftOut[k];
      any |= near.near[k];
    }
    if (any != 0) found.push_back(near);
  }
}
VECTOR_CLONES(void, findNearFloats,
              (std::span<const Tile> tiles, const Arrays<const float>& positions, std::uint32_t tile,
               std::span<const std::uint32_t> others, float reachSquared, bool neighbors,
               std::vector<NearTile>& found),
              (tiles, positions, tile, others, reachSquared, neighbors, found),
              findNear(tiles, positions, tile, others, reachSquared, neighbors, found))

}  // namespace

template <class Real>
TileSearch<Real>::TileSearch(const Cloth& cloth) {
  for (std::uint32_t number = 0; number < cloth.pieces().size(); ++number) {
    const Piece& piece = cloth.pieces()[number];
    piece.isMesh ? addMesh(cloth, piece, number) : addGrid(piece, number);
  }
  positions_.resize(particles_.size());
  for (auto* c : {&positions_.x, &positions_.y, &positions_.z})
    std::fill_n(c->data(), particles_.size(), std::numeric_limits<Real>::quiet_NaN());
  firstGroups_ = {0};
  for (std::uint32_t boxes = tiles(); firstGroups_.size() == 1 || boxes > 1;) {
    boxes = (boxes + CHILDREN - 1) / CHILDREN;
    firstGroups_.push_back(firstGroups_.back() + boxes);
  }
  groups_.resize(firstGroups_.back());
}

template <class Real>
void TileSearch<Real>::addGrid(const Piece& piece, std::uint32_t number) {
  std::vector<std::pair<std::uint64_t, Tile>> places;
  for (int row = 0; row * TILE_SIDE < piece.rows; ++row)
    for (int column = 0; column * TILE_SIDE < piece.columns; ++column)
      places.push_back({placeOnCurve(static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)),
                        {number, true, column, row}});
  std::ranges::sort(places, {}, [](const auto& each) { return each.first; });
  for (const auto& [place, tile] : places) {
    std::array<std::uint32_t, TILE> particles;
    for (int k = 0; k < static_cast<int>(TILE); ++k) {
      const int column = TILE_SIDE * tile.column + k % TILE_SIDE, row = TILE_SIDE * tile.row + k / TILE_SIDE;
      const bool isThere = column < piece.columns && row < piece.rows;
      particles[static_cast<std::size_t>(k)] =
          isThere ? piece.firstParticle + static_cast<std::uint32_t>(row * piece.columns + column) : NOBODY;
    }
    addTile(tile, particles);
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
  for (std::size_t first = 0; first < places.size(); first += TILE) {
    std::array<std::uint32_t, TILE> particles;
    for (std::size_t k = 0; k < TILE; ++k)
      particles[k] = first + k < places.size() ? places[first + k].second : NOBODY;
    addTile({number, false, 0, 0}, particles);
  }
}

template <class Real>
void TileSearch<Real>::addTile(const Tile& tile, std::span<const std::uint32_t, TILE> particles) {
  tiles_.push_back(tile);
  particles_.insert(particles_.end(), particles.begin(), particles.end());
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
        if (particles_[place] == NOBODY) continue;
        const Four<Real> x = fourAt(from, particles_[place]);
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
void TileSearch<Real>::findTiles(std::uint32_t group, Real reachSquared,
                                 std::array<std::vector<std::uint32_t>, CHILDREN>& others) const {
  const Real reach = std::sqrt(reachSquared) * Real(1.0001);  // whatever is rounded on the way
  const Four<Real> around{reach, reach, reach, Real(0)};
  const auto widened = [&](const Bounds<Real>& box) {
    return Bounds<Real>{box.low - around, box.high + around};
  };
  const Bounds<Real> all = widened(groups_[group].all());
  std::array<Bounds<Real>, CHILDREN> own;
  for (std::uint32_t k = 0; k < CHILDREN; ++k) {
    own[k] = widened(groups_[group].at(k));
    others[k].clear();
  }
  const auto forEachMeeting = [&](std::uint32_t number, const Bounds<Real>& box, auto work) {
    for (std::uint32_t left = bitsOfFour(overlap(groups_[number], box)); left != 0; left &= left - 1)
      work(static_cast<std::uint32_t>(std::countr_zero(left)));
  };
  struct Place {
    std::size_t level;
    std::uint32_t group;
  };
  std::array<Place, 64> open;
  std::size_t count = 0;
  open[count++] = {firstGroups_.size() - 2, 0};
  while (count > 0) {
    const Place place = open[--count];
    if (place.level > 0)
      forEachMeeting(firstGroups_[place.level] + place.group, all, [&](std::uint32_t child) {
        open[count++] = {place.level - 1, CHILDREN * place.group + child};
      });
    else
      for (std::uint32_t k = 0; k < CHILDREN; ++k)
        forEachMeeting(place.group, own[k],
                       [&](std::uint32_t tile) { others[k].push_back(CHILDREN * place.group + tile); });
  }
}

template <class Real>
void TileSearch<Real>::findIn(std::uint32_t tile, std::span<const std::uint32_t> others, Real reachSquared,
                              bool neighbors, std::vector<NearTile>& found) const {
  const Arrays<const Real> positions = arraysOf(positions_);
  if constexpr (std::is_same_v<Real, float>)
    findNearFloats(tiles_, positions, tile, others, reachSquared, neighbors, found);
  else
    findNear<Real>(tiles_, positions, tile, others, reachSquared, neighbors, found);
}

template class TileSearch<float>;
template class TileSearch<double>;

}  // namespace clothsim::cpu
