// Which particles are near each other. Sixteen particles that lie together at rest, four by four of a grid,
// are a tile; boxes around the tiles form a tree, and tiles whose boxes are far apart are not looked at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "solver/cpu/bounds.h"
#include "solver/cpu/cpu_state.h"

namespace clothsim::cpu {

inline constexpr std::uint32_t TILE = 16;

// Which particles of a tile lie near those of another: bit j of near[k] is the tile's j-th near the other's
// k-th.
struct NearTile {
  std::uint32_t tile;
  std::array<std::uint32_t, TILE> near;
};

// Sixteen particles at most.
struct Tile {
  std::uint32_t piece;
  bool isOfGrid;
  int column, row;  // of its grid, in tiles
};

template <class Real>
class TileSearch {
 public:
  static constexpr std::uint32_t NOBODY = ~0u;

  TileSearch() = default;
  explicit TileSearch(const Cloth& cloth);

  [[nodiscard]] std::uint32_t tiles() const { return static_cast<std::uint32_t>(tiles_.size()); }
  [[nodiscard]] std::uint32_t pieceOf(std::uint32_t tile) const { return tiles_[tile].piece; }
  // TILE of them; where a tile has fewer, some are NOBODY and near nothing.
  [[nodiscard]] const std::uint32_t* particlesOf(std::uint32_t tile) const {
    return &particles_[std::size_t{tile} * TILE];
  }

  // Where the particles are, for find().
  void setPositions(const Components<Real>& positions);
  // Tiles are searched for by groups of a few.
  [[nodiscard]] std::uint32_t groups() const { return firstGroups_[1]; }
  // Calls take(tile, what is near it) for the tiles of a group: everything within sqrt(reachSquared), of
  // which each particle is itself. Without `neighbors`, particles within one cell of a grid are left out.
  template <class Take>
  void find(std::uint32_t group, Real reachSquared, bool neighbors, Take take) const {
    thread_local std::array<std::vector<std::uint32_t>, CHILDREN> others;
    thread_local std::vector<NearTile> found;
    findTiles(group, reachSquared, others);
    for (std::uint32_t k = 0; k < CHILDREN && CHILDREN * group + k < tiles(); ++k) {
      found.clear();
      findIn(CHILDREN * group + k, others[k], reachSquared, neighbors, found);
      take(CHILDREN * group + k, std::span<const NearTile>(found));
    }
  }

 private:
  static constexpr std::uint32_t CHILDREN = 4;  // of a node of the tree

  void addGrid(const Piece& piece, std::uint32_t number);
  void addMesh(const Cloth& cloth, const Piece& piece, std::uint32_t number);
  void addTile(const Tile& tile, std::span<const std::uint32_t, TILE> particles);
  // The tiles that may have particles near those of a group's tiles, by tile of the group.
  void findTiles(std::uint32_t group, Real reachSquared,
                 std::array<std::vector<std::uint32_t>, CHILDREN>& others) const;
  // What is near a tile's particles among the particles of others.
  void findIn(std::uint32_t tile, std::span<const std::uint32_t> others, Real reachSquared, bool neighbors,
              std::vector<NearTile>& found) const;

  std::vector<Tile> tiles_;
  // By tile, TILE of each; of a grid by rows of four.
  std::vector<std::uint32_t> particles_;
  Components<Real> positions_;  // no number where there is no particle
  // Of each level, the tiles' first, and one more: how many there are.
  std::vector<std::uint32_t> firstGroups_;
  std::vector<FourBounds<Real>> groups_;  // each of four below it
};

extern template class TileSearch<float>;
extern template class TileSearch<double>;

}  // namespace clothsim::cpu
