// Which particles are near each other. Sixteen particles that lie together at rest, four by four of a grid,
// are a tile; boxes around the tiles form a tree, and tiles whose boxes are far apart are not looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "solver/cpu/bounds.h"
#include "solver/cpu/cpu_state.h"

namespace clothsim::cpu {

inline constexpr std::uint32_t TILE = 16;

// A particle, and which particles of a tile lie near it: bit k is the tile's k-th.
struct NearTile {
  std::uint32_t particle, near;
};

template <class Real>
class TileSearch {
 public:
  TileSearch() = default;
  explicit TileSearch(const Cloth& cloth);

  [[nodiscard]] std::uint32_t tiles() const { return static_cast<std::uint32_t>(tiles_.size()); }
  [[nodiscard]] std::uint32_t pieceOf(std::uint32_t tile) const { return tiles_[tile].piece; }
  // At most TILE.
  [[nodiscard]] std::span<const std::uint32_t> particlesOf(std::uint32_t tile) const {
    return {&particles_[std::size_t{tile} * TILE], tiles_[tile].count};
  }

  // Where the particles are, for find().
  void setPositions(const Components<Real>& positions);
  // Adds to `found` who lies within sqrt(reachSquared) of a particle of the tile and is not its neighbour on
  // the grid: at most sqrt(neighborsSquared) columns and rows away. On meshes, and where neighborsSquared is
  // negative, a particle finds itself, too.
  void find(std::uint32_t tile, Real reachSquared, Real neighborsSquared, std::vector<NearTile>& found) const;

 private:
  struct Tile {
    std::uint32_t piece, count;
    bool isGrid;
  };

  void addGrid(const Piece& piece, std::uint32_t number);
  void addMesh(const Cloth& cloth, const Piece& piece, std::uint32_t number);
  void addTile(std::span<const std::uint32_t> particles, const Piece& piece, std::uint32_t number);

  std::vector<Tile> tiles_;
  // By tile, TILE of each; where it has fewer, the last is there again.
  std::vector<std::uint32_t> particles_;
  std::vector<Real> columns_, rows_;  // on the grid of its piece
  Components<Real> positions_;
  // Of each level, the tiles' first, and one more: how many there are.
  std::vector<std::uint32_t> firstGroups_;
  std::vector<FourBounds<Real>> groups_;  // each of four below it
};

extern template class TileSearch<float>;
extern template class TileSearch<double>;

}  // namespace clothsim::cpu
