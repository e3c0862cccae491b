#include "cloth/seams.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "cloth/cloth.h"
#include "cloth/pins.h"
#include "core/error.h"

namespace clothsim {
namespace {

void appendLine(const GridRange& line, const Piece& piece, std::vector<std::uint32_t>& points) {
  for (int row = line.from.row; row <= line.to.row; ++row)
    for (int column = line.from.column; column <= line.to.column; ++column)
      points.push_back(piece.particle(column, row));
}

// The particles of a side in the order in which they are sewn.
std::vector<std::uint32_t> pointsOf(const SeamSide& side, const std::string& name, const Scene& scene,
                                    std::span<const Piece> pieces) {
  const auto number = static_cast<std::size_t>(side.cloth);
  const ClothSettings& cloth = scene.cloths[number];
  const Piece& piece = pieces[number];
  std::vector<std::uint32_t> points;
  if (cloth.isMesh()) {
    const std::vector<double> weights = weightsOf(side.points, cloth, name + ".points");
    for (std::uint32_t i = 0; i < weights.size(); ++i)
      if (weights[i] > 0.5) points.push_back(piece.firstParticle + i);
  } else {
    for (const Pin& pin : side.points) {
      const GridRange line = pointsOf(pin, cloth);
      if (line.from.column != line.to.column && line.from.row != line.to.row)
        throw SceneError(name + ": expected points of one row or one column, found a block");
      appendLine(line, piece, points);
    }
  }
  if (points.empty()) throw SceneError(name + ": expected points to sew, found none");
  if (side.reverse) std::reverse(points.begin(), points.end());
  return points;
}

// The particle of a line that lies as far along it as number k of `count` does.
std::uint32_t alongLine(const std::vector<std::uint32_t>& line, std::size_t k, std::size_t count) {
  if (count < 2) return line.front();
  const double place =
      static_cast<double>(k) * static_cast<double>(line.size() - 1) / static_cast<double>(count - 1);
  return line[static_cast<std::size_t>(std::floor(place + 0.5))];
}

std::uint32_t nearestTo(std::uint32_t particle, const std::vector<std::uint32_t>& others,
                        std::span<const Vec3d> positions) {
  return *std::min_element(others.begin(), others.end(), [&](std::uint32_t p, std::uint32_t q) {
    const Vec3d dp = positions[p] - positions[particle], dq = positions[q] - positions[particle];
    return dot(dp, dp) < dot(dq, dq);
  });
}

}  // namespace

std::vector<SeamSpring> seamSprings(const Scene& scene, std::span<const Piece> pieces,
                                    std::span<const Vec3d> positions) {
  std::vector<SeamSpring> springs;
  for (std::size_t s = 0; s < scene.seams.size(); ++s) {
    const Seam& seam = scene.seams[s];
    const std::string name = "seams." + std::to_string(s);
    const std::vector<std::uint32_t> a = pointsOf(seam.a, name + ".a", scene, pieces),
                                     b = pointsOf(seam.b, name + ".b", scene, pieces);
    const auto clothOf = [&](const SeamSide& side) -> const ClothSettings& {
      return scene.cloths[static_cast<std::size_t>(side.cloth)];
    };
    const auto pieceOf = [&](const SeamSide& side) -> const Piece& {
      return pieces[static_cast<std::size_t>(side.cloth)];
    };
    const bool areLines = !clothOf(seam.a).isMesh() && !clothOf(seam.b).isMesh();
    const double stiffness =
        seam.stiffness.value_or(std::max(pieceOf(seam.a).stiffestSpring(), pieceOf(seam.b).stiffestSpring()));
    const std::size_t first = springs.size();
    const bool aIsFiner = a.size() >= b.size();
    const std::vector<std::uint32_t>&fine = aIsFiner ? a : b, &coarse = aIsFiner ? b : a;
    for (std::size_t k = 0; k < fine.size(); ++k) {
      const std::uint32_t own = fine[k];
      const std::uint32_t other =
          areLines ? alongLine(coarse, k, fine.size()) : nearestTo(own, coarse, positions);
      if (own == other) continue;
      springs.push_back(
          {aIsFiner ? own : other, aIsFiner ? other : own, static_cast<std::uint32_t>(s), stiffness});
    }
    if (springs.size() == first)
      throw SceneError(name + ": expected two borders, found the same points on both sides");
  }
  return springs;
}

double seamLengthFactor(const Seam& seam, double time) {
  return seam.time > 0 ? std::clamp(1 - time / seam.time, 0.0, 1.0) : 0;
}

}  // namespace clothsim
