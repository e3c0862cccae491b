#include "solver/tearing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clothsim {
namespace {

// The structural springs of a grid: two a particle, to the left and to the upper neighbour.
class Strains {
 public:
  Strains(const Cloth& cloth, const Piece& piece, const Cuts& cuts, std::span<const Particle4> positions)
      : piece_(piece), strains_(2 * std::size_t{piece.particleCount()}, NONE) {
    for (int row = 0; row < piece.rows; ++row)
      for (int column = 0; column < piece.columns; ++column)
        for (const SpringSlot slot : {toLeft, toUpper}) measure(cloth, cuts, positions, column, row, slot);
  }

  // l/L - 1; NONE where there is no such spring.
  [[nodiscard]] double of(int column, int row, SpringSlot slot) const {
    return piece_.contains(column, row) ? strains_[place(column, row, slot)] : NONE;
  }
  // Whether no spring at its ends is stretched more; of equal ones the first.
  [[nodiscard]] bool isLargest(int column, int row, SpringSlot slot) const {
    const SpringOffset& offset = springOffsets[slot];
    const double own = of(column, row, slot);
    const auto staysBehind = [&](int c, int r, SpringSlot s) {
      const double other = of(c, r, s);
      return other < own || (other == own && place(c, r, s) >= place(column, row, slot));
    };
    for (const auto& [c, r] : {std::pair{column, row}, std::pair{column + offset.columns, row + offset.rows}})
      if (!staysBehind(c, r, toLeft) || !staysBehind(c + 1, r, toLeft) || !staysBehind(c, r, toUpper) ||
          !staysBehind(c, r + 1, toUpper))
        return false;
    return true;
  }

 private:
  static constexpr double NONE = -1;

  [[nodiscard]] std::size_t place(int column, int row, SpringSlot slot) const {
    return 2 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(piece_.columns) +
                static_cast<std::size_t>(column)) +
           (slot == toLeft ? 0 : 1);
  }
  void measure(const Cloth& cloth, const Cuts& cuts, std::span<const Particle4> positions, int column,
               int row, SpringSlot slot) {
    const SpringOffset& offset = springOffsets[slot];
    const int otherColumn = column + offset.columns, otherRow = row + offset.rows;
    if (!piece_.slotEnabled[slot] || !piece_.contains(otherColumn, otherRow)) return;
    const std::uint32_t a = piece_.particle(column, row), b = piece_.particle(otherColumn, otherRow);
    if (isCut(cuts, a, slot)) return;
    const double rest = cloth.restLength(piece_, slot, a, b);
    strains_[place(column, row, slot)] = length(vectorOf(positions[b]) - vectorOf(positions[a])) / rest - 1;
  }

  const Piece& piece_;
  std::vector<double> strains_;
};

// Across the middle of a spring, from the middle of one cell beside it to the middle of the other, and past
// the springs that cross there.
bool tearAcross(Cuts& cuts, const Cloth& cloth, std::size_t piece, int column, int row, SpringSlot slot) {
  const SpringOffset& offset = springOffsets[slot];
  const LatticePoint middle{column + 0.5 * offset.columns, row + 0.5 * offset.rows};
  constexpr double REACH = 0.51;  // [cells]
  const double across = REACH * offset.rows, along = REACH * offset.columns;
  return cutAlong(cuts, cloth, piece, {middle.column - across, middle.row - along},
                  {middle.column + across, middle.row + along});
}

double strainOf(const Cloth& cloth, const Piece& mesh, const MeshSpring& edge,
                std::span<const Particle4> positions) {
  const double rest = cloth.restLength(mesh, 0, edge.a, edge.b);
  return length(vectorOf(positions[edge.b]) - vectorOf(positions[edge.a])) / rest - 1;
}

bool tearMesh(Cuts& cuts, const Cloth& cloth, const Piece& mesh, double limit,
              std::span<const Particle4> positions) {
  const std::vector<MeshSpring>& springs = cloth.lists().springs;
  // At each particle the longest of its edges, of equal ones the first.
  struct Longest {
    double strain = -1;
    const MeshSpring* edge = nullptr;
  };
  std::vector<Longest> longest(mesh.particleCount());
  const auto at = [&](std::uint32_t particle) -> Longest& { return longest[particle - mesh.firstParticle]; };
  const auto forEachEdge = [&](auto visit) {
    for (const auto& [first, end] : mesh.colors)
      for (std::uint32_t n = first; n < end; ++n)
        if (springs[n].kind == SpringKind::structural) visit(springs[n]);
  };
  forEachEdge([&](const MeshSpring& edge) {
    if (isCut(cuts, cloth, edge)) return;
    const double strain = strainOf(cloth, mesh, edge, positions);
    for (const std::uint32_t end : {edge.a, edge.b})
      if (strain > at(end).strain) at(end) = {strain, &edge};
  });
  // Those that tear share no particle, and so no triangle.
  bool any = false;
  forEachEdge([&](const MeshSpring& edge) {
    if (at(edge.a).edge != &edge || at(edge.b).edge != &edge || !(at(edge.a).strain > limit)) return;
    tearEdge(cuts, cloth, edge);
    any = true;
  });
  return any;
}

}  // namespace

bool canTear(const Scene& scene) {
  return std::any_of(scene.cloths.begin(), scene.cloths.end(),
                     [](const ClothSettings& cloth) { return cloth.tearStrain.has_value(); });
}

bool tear(Cuts& cuts, const Cloth& cloth, const Scene& scene, std::span<const Particle4> positions) {
  bool any = false;
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const Piece& piece = cloth.pieces()[i];
    const std::optional<double> limit = scene.cloths[i].tearStrain;
    if (limit && piece.isMesh) any |= tearMesh(cuts, cloth, piece, *limit, positions);
    if (!limit || piece.isMesh) continue;
    const Strains strains(cloth, piece, cuts, positions);
    for (int row = 0; row < piece.rows; ++row)
      for (int column = 0; column < piece.columns; ++column)
        for (const SpringSlot slot : {toLeft, toUpper})
          if (strains.of(column, row, slot) > *limit && strains.isLargest(column, row, slot))
            any |= tearAcross(cuts, cloth, i, column, row, slot);
  }
  return any;
}

}  // namespace clothsim
