// Into which points and triangles the smooth surface divides triangles of meshes and of cut grids. Neighbours
// have the points on their common side in common, so that no gap opens.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "core/vec.h"
#include "render/triangle_sides.h"

namespace clothsim {

// A point between particles, as steps of the smooth surface away from each: inside a triangle and on its
// sides between its three corners, which count first, second and third; on a border on the curve from the
// second to the third of four particles in a row, which count by the steps from there.
struct PatchPoint {
  std::array<std::uint32_t, 4> particles;
  std::array<std::uint32_t, 4> steps;  // the last: 1 on a border, else 0
};

struct Patches {
  std::vector<PatchPoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;   // of points, turned as those of the cloth
  std::vector<BorderCorner> border;                      // of points
  std::vector<std::array<float, 2>> textureCoordinates;  // of points
};

// Of triangles whose sides have `steps`, 1 to 8. Points are numbered from `firstPoint`. `rest` and
// `textureCoordinates` are those of all particles; borders are curves but where they turn by more than 45
// degrees at rest. At seams of the texture there are several points at one place.
[[nodiscard]] Patches divideTriangles(std::span<const std::array<std::uint32_t, 3>> triangles,
                                      std::uint32_t steps, std::uint32_t firstPoint,
                                      std::span<const Vec3d> rest,
                                      std::span<const std::array<float, 2>> textureCoordinates,
                                      const TextureSeams& textureSeams = {});

}  // namespace clothsim
