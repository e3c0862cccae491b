// The points of a cloth as its texture sees them: a point at a seam of the texture is several ones.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cloth/cloth.h"

namespace clothsim {

class TexturePoints {
 public:
  struct Point {
    std::uint32_t particle;
    std::array<float, 2> coordinates;  // u, and v counted from the lower edge of a picture
  };
  TexturePoints(const Cloth& cloth, const Piece& piece);

  // First the particles of the piece, in their order, with coordinates of their own; then those at seams.
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] bool hasSeams() const { return !ofTriangles_.empty(); }
  // The corners of a triangle of the piece, whose particles are given, as places in points().
  [[nodiscard]] std::array<std::uint32_t, 3> of(const std::array<std::uint32_t, 3>& triangle) const;

 private:
  std::uint32_t firstParticle_;
  std::vector<Point> points_;
  std::map<std::array<std::uint32_t, 3>, std::array<std::uint32_t, 3>> ofTriangles_;  // at seams
};

}  // namespace clothsim
