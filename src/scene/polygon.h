// Polygons as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/vec.h"

namespace clothsim {

// The corners of triangles that cover a polygon of three corners or more, with its winding. Four corners are
// split by the shorter diagonal; more, or four where that diagonal lies outside or along a side, by cutting
// off ears, those with the shortest third side first (G. H. Meisters, "Polygons have ears", 1975). Corners
// may lie along a side. What crosses itself gets triangles of some kind.
[[nodiscard]] std::vector<std::array<std::size_t, 3>> trianglesOf(std::span<const Vec3d> polygon);

}  // namespace clothsim
