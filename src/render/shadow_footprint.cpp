#include "render/shadow_footprint.h"

#include <algorithm>
#include <cmath>

namespace clothsim {
namespace {

struct CellRange {
  int first, end;
};

CellRange cellsOf(float low, float high) {
  if (!(low <= high)) return {0, 0};
  const auto cell = [](float at) {
    constexpr auto cells = static_cast<float>(ShadowFootprint::CELLS);
    return static_cast<int>(std::floor(std::clamp(at * cells, -1.0f, cells)));
  };
  return {std::max(cell(low), 0), std::min(cell(high) + 1, ShadowFootprint::CELLS)};
}

}  // namespace

void ShadowFootprint::add(const FlatBounds& box) {
  const CellRange columns = cellsOf(box.low.x, box.high.x), rows = cellsOf(box.low.y, box.high.y);
  for (int row = rows.first; row < rows.end; ++row)
    for (int column = columns.first; column < columns.end; ++column) cells_.set(index(column, row));
}

FlatBounds ShadowFootprint::bounds() const {
  FlatBounds all;
  for (int row = 0; row < CELLS; ++row)
    for (int column = 0; column < CELLS; ++column)
      if (has(column, row)) all.add(cell(column, row));
  return all;
}

// Grids by blocks of two cells a side, as they also cast shadows coarsely.
ShadowFootprint footprintOf(const Cloth& cloth, std::span<const glm::vec2> places, float margin) {
  ShadowFootprint all;
  for (const Piece& piece : cloth.pieces()) {
    if (piece.isMesh) continue;
    for (int row = 0; row + 1 < piece.rows; row += 2)
      for (int column = 0; column + 1 < piece.columns; column += 2) {
        FlatBounds block;
        for (int r = row; r <= std::min(row + 2, piece.rows - 1); ++r)
          for (int c = column; c <= std::min(column + 2, piece.columns - 1); ++c)
            block.add(places[piece.particle(c, r)]);
        all.add(block.grown(margin));
      }
  }
  for (const auto& triangle : cloth.lists().triangles) {
    FlatBounds box;
    for (const std::uint32_t corner : triangle) box.add(places[corner]);
    all.add(box.grown(margin));
  }
  return all;
}

}  // namespace clothsim
