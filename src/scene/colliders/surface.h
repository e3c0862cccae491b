// For the surfaces of shapes: points, cells between them, and how much smaller than it is a shape is drawn.
#pragma once

#include "scene/colliders/shape.h"

namespace clothsim {

inline constexpr int quarterSegments = 16;  // of a quarter of a circle

// Rows and columns of points, of which the rows close; the two triangles of a cell each.
void addCells(Surface& surface, int rows, int columns);

// What a line in the half-plane beside y makes when it goes around y. It runs with the inside of the shape on
// its left; where it has a sharp corner, the point is there twice, with a normal for either side.
struct ProfilePoint {
  double radius, y;              // distance from the axis, height [m]
  double normalRadius, normalY;  // unit
};
[[nodiscard]] Surface revolved(const std::vector<ProfilePoint>& profile);

// How far inside of a flat face it is drawn: apart from cloth on it in the depth buffer. `size` [m]: the
// smallest of the shape. Here and below, `longestEdge` is the longest side of the cloth's triangles [m]; 0:
// there is no cloth, and the shape is not made smaller.
[[nodiscard]] double faceInset(double size, double longestEdge);

// A sphere whose eight octants were pulled apart by `half` in each direction: a rounded box; along y alone a
// capsule. Points where octants meet are there twice, and the cells between them are edges and faces.
[[nodiscard]] Surface pulledApart(double halfX, double halfY, double halfZ, double radius);

// How much smaller than its true radius a sphere must be drawn so that cloth on it never dips below what is
// drawn. The particles lie on the sphere; the flat triangles between them sink under it by the sagitta of
// their circumscribed circle. (The drawn sphere's own facets only sink further.)
[[nodiscard]] double sphereShrink(double radius, double longestEdge);

// The magnitude of each component.
[[nodiscard]] Vec3d magnitude(Vec3d v);

}  // namespace clothsim
