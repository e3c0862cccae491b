#include "solver/implicit.h"

#include <algorithm>

#include "cloth/cuts.h"

namespace clothsim {
namespace {

// Points of the next coarser line: every second one, and the last.
std::uint32_t coarsened(std::uint32_t points) { return points > 2 ? points / 2 + 1 : points; }

// Sum of the squares of a hat of so many cells to each side.
double squares(double cells) { return (2 * cells * cells + 1) / (3 * cells); }
// Sum of its squared slopes.
double slopes(double cells) { return 2 / cells; }

template <class Real>
void putFactors(const Piece& piece, double across, double along, LevelParams<Real>& level) {
  const double area = across * along;
  const double x = slopes(across) * squares(along) / area, y = slopes(along) * squares(across) / area;
  const double mean = piece.rows == 1 ? x : piece.columns == 1 ? y : 0.5 * (x + y);
  level.stiffnessFactor = static_cast<Real>(mean);
  level.inertiaFactor = static_cast<Real>(squares(across) * squares(along) / area);
  // A hat bends at three points: 1 + 4 + 1 over the square of its width.
  level.bending = static_cast<Real>(6 * piece.bendAlongRow * squares(along) / (across * across) +
                                    6 * piece.bendAlongColumn * squares(across) / (along * along));
}

std::int64_t sign(std::int64_t x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// Of a level: which of its coarse vertices are cut off from each other, from the links of the fine ones.
template <class Real>
class CoarseLinks {
 public:
  CoarseLinks(const LevelParams<Real>& level, std::vector<std::uint32_t>& links)
      : level_(level), links_(links) {}

  void put() {
    for (std::int64_t row = 0; row < level_.coarseRows; ++row)
      for (std::int64_t column = 0; column < level_.coarseColumns; ++column)
        links_[level_.coarseFirst + static_cast<std::size_t>(row * level_.coarseColumns + column)] =
            linksOf({column, row});
  }

 private:
  struct Point {
    std::int64_t column, row;
  };

  [[nodiscard]] std::uint32_t linksOf(Point own) const {
    std::uint32_t links = 0;
    for (int rows = -1; rows <= 1; ++rows)
      for (int columns = -1; columns <= 1; ++columns) {
        const Point other{own.column + columns, own.row + rows};
        if (isVertex(other) && (isWayCut(own, other) || isWayCut(other, own)))
          links |= LINK_BIT(columns, rows);
      }
    return links;
  }
  [[nodiscard]] bool isVertex(Point p) const {
    return p.column >= 0 && p.row >= 0 && p.column < level_.coarseColumns && p.row < level_.coarseRows;
  }
  [[nodiscard]] Point finePointOf(Point p) const {
    return {finePoint<std::int64_t>(p.column, level_.coarseColumns, level_.fineColumns),
            finePoint<std::int64_t>(p.row, level_.coarseRows, level_.fineRows)};
  }
  [[nodiscard]] bool isWayCut(Point from, Point to) const {
    const Point end = finePointOf(to);
    for (Point at = finePointOf(from); at.column != end.column || at.row != end.row;) {
      const std::int64_t columns = sign(end.column - at.column), rows = sign(end.row - at.row);
      const std::size_t i =
          level_.fineFirst + static_cast<std::size_t>(at.row * level_.fineColumns + at.column);
      if ((links_[i] & LINK_BIT(columns, rows)) != 0) return true;
      at = {at.column + columns, at.row + rows};
    }
    return false;
  }

  const LevelParams<Real>& level_;
  std::vector<std::uint32_t>& links_;
};

}  // namespace

template <class Real>
Hierarchy<Real> makeHierarchy(const Cloth& cloth) {
  Hierarchy<Real> hierarchy;
  hierarchy.vertices = cloth.particleCount();
  for (const Piece& piece : cloth.pieces()) {
    std::vector<LevelParams<Real>>& levels = hierarchy.pieces.emplace_back();
    std::uint32_t first = piece.firstParticle, columns = static_cast<std::uint32_t>(piece.columns),
                  rows = static_cast<std::uint32_t>(piece.rows);
    double across = 1, along = 1;  // width of a hat, in cells of the grid
    while (!piece.isMesh && (columns > 2 || rows > 2)) {
      LevelParams<Real> level{};
      level.fineFirst = first;
      level.fineColumns = columns;
      level.fineRows = rows;
      if (columns > 2) across *= 2;
      if (rows > 2) along *= 2;
      level.coarseFirst = first = hierarchy.vertices;
      level.coarseColumns = columns = coarsened(columns);
      level.coarseRows = rows = coarsened(rows);
      hierarchy.vertices += columns * rows;
      putFactors(piece, across, along, level);
      levels.push_back(level);
    }
  }
  return hierarchy;
}

template <class Real>
std::vector<std::uint32_t> makeCutLinks(const Cloth& cloth, const std::vector<std::uint32_t>& cutMasks,
                                        const Hierarchy<Real>& hierarchy) {
  if (cutMasks.empty()) return {};
  std::vector<std::uint32_t> links(hierarchy.vertices);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    for (int rows = -1; rows <= 1; ++rows)
      for (int columns = -1; columns <= 1; ++columns)
        if ((cutMasks[i] >> springWithinCell(columns, rows) & 1) != 0) links[i] |= LINK_BIT(columns, rows);
  for (const std::vector<LevelParams<Real>>& levels : hierarchy.pieces)
    for (const LevelParams<Real>& level : levels) CoarseLinks<Real>(level, links).put();
  return links;
}

template Hierarchy<float> makeHierarchy(const Cloth&);
template Hierarchy<double> makeHierarchy(const Cloth&);
template std::vector<std::uint32_t> makeCutLinks(const Cloth&, const std::vector<std::uint32_t>&,
                                                 const Hierarchy<float>&);
template std::vector<std::uint32_t> makeCutLinks(const Cloth&, const std::vector<std::uint32_t>&,
                                                 const Hierarchy<double>&);

}  // namespace clothsim
