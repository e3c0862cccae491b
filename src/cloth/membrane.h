// The membrane of a mesh of a material: triangles that resist strain in their plane, with moduli of the weft,
// the warp and shear (docs/physics.md).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace clothsim {

struct ClothSettings;
struct MeshShape;

// Of a triangle whose edge k lies opposite corner k, with e_k = (l_k^2 - L_k^2) / 2, which is D_k.E D_k of
// its Green strain E and its edge D_k at rest: the energy is 1/2 |R e|^2, R upper triangular, row by row.
// Rows that are a square root of the matrix keep the energy positive in any arithmetic [sqrt(N)/m^1.5].
using MembraneRoots = std::array<double, 6>;

// Edge k of a triangle goes from its corner k + 1 to its corner k + 2.
using TriangleEdges = std::array<Vec3d, 3>;
[[nodiscard]] TriangleEdges edgesOf(const std::array<std::uint32_t, 3>& corners,
                                    const std::vector<Vec3d>& points);

// The membranes of the triangles of a mesh at `points`, of the cloth's material. In each triangle the weft
// goes where its second texture coordinate does not change, and the warp at right angles to it.
[[nodiscard]] std::vector<MembraneRoots> membranesOf(const MeshShape& shape, const std::vector<Vec3d>& points,
                                                     const ClothSettings& cloth);

// R e.
[[nodiscard]] std::array<double, 3> timesRoots(const MembraneRoots& roots, const std::array<double, 3>& e);

// The stiffness along edge k while the others keep their lengths [N/m].
[[nodiscard]] double stiffnessAlong(std::size_t k, const TriangleEdges& edges, const MembraneRoots& roots);

// What bounds the largest eigenvalue of the triangle's stiffness matrix, at rest [N/m].
[[nodiscard]] double membraneBound(const TriangleEdges& edges, const MembraneRoots& roots);

}  // namespace clothsim
