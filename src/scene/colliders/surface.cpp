#include "scene/colliders/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clothsim {

void addCells(Surface& surface, int rows, int columns) {
  const auto index = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * columns + column % columns);
  };
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = index(row, column), b = index(row, column + 1);
      const std::uint32_t c = index(row + 1, column), d = index(row + 1, column + 1);
      surface.indices.insert(surface.indices.end(), {a, c, b, b, c, d});
    }
}

Surface revolved(const std::vector<ProfilePoint>& profile) {
  constexpr int around = 8 * quarterSegments;
  Surface surface;
  for (const ProfilePoint& point : profile)
    for (int column = 0; column < around; ++column) {
      const double angle = 2 * std::numbers::pi * column / around;
      const Vec3d away{std::sin(angle), 0, std::cos(angle)}, up{0, 1, 0};
      surface.vertices.push_back({(point.radius * away + point.y * up).cast<float>(),
                                  (point.normalRadius * away + point.normalY * up).cast<float>()});
    }
  addCells(surface, static_cast<int>(profile.size()), around);
  return surface;
}

double faceInset(double size, double longestEdge) {
  if (longestEdge <= 0) return 0;
  return std::min(0.003 * size + 0.05 * longestEdge, 0.1 * size);
}

Surface pulledApart(double halfX, double halfY, double halfZ, double radius) {
  Surface surface;
  constexpr int n = quarterSegments;
  for (int row = 0; row < 2 * (n + 1); ++row) {
    const bool upper = row <= n;
    const double polar = 0.5 * std::numbers::pi * (upper ? row : row - 1) / n;
    for (int quarter = 0; quarter < 4; ++quarter)
      for (int i = 0; i <= n; ++i) {
        const double azimuth = 0.5 * std::numbers::pi * (quarter + static_cast<double>(i) / n);
        const double sideX = quarter < 2 ? 1 : -1, sideZ = quarter == 0 || quarter == 3 ? 1 : -1;
        const Vec3d normal{std::sin(polar) * std::sin(azimuth), std::cos(polar),
                           std::sin(polar) * std::cos(azimuth)};
        const Vec3d corner{sideX * halfX, upper ? halfY : -halfY, sideZ * halfZ};
        surface.vertices.push_back({(corner + radius * normal).cast<float>(), normal.cast<float>()});
      }
  }
  constexpr int columns = 4 * (n + 1), rows = 2 * (n + 1);
  addCells(surface, rows, columns);
  const auto cap = [&](int row, bool up) {
    std::array<std::uint32_t, 4> corners{};
    for (int q = 0; q < 4; ++q)
      corners[static_cast<std::size_t>(q)] = static_cast<std::uint32_t>(row * columns + q * (n + 1));
    if (!up) std::swap(corners[1], corners[3]);
    surface.indices.insert(surface.indices.end(),
                           {corners[0], corners[1], corners[2], corners[0], corners[2], corners[3]});
  };
  cap(0, true);
  cap(rows - 1, false);
  return surface;
}

double sphereShrink(double radius, double longestEdge) {
  if (longestEdge <= 0) return 0;
  // The hypotenuse of a right triangle is its circumscribed circle's diameter. Stretched cloth has longer
  // edges: 10 %.
  const double half = std::min(0.5 * 1.1 * longestEdge, radius);
  const double sagitta = radius - std::sqrt(radius * radius - half * half);
  const double againstFlicker = 0.003 * radius;  // keeps the two surfaces apart in the depth buffer
  return std::min(sagitta + againstFlicker, 0.5 * radius);
}

Vec3d magnitude(Vec3d v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

}  // namespace clothsim
