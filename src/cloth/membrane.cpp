#include "cloth/membrane.h"

#include <algorithm>
#include <cmath>

#include "cloth/material.h"
#include "cloth/mesh_shape.h"
#include "scene/scene.h"

namespace clothsim {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Vec3d rowOf(const Matrix& m, std::size_t r) { return {m[r][0], m[r][1], m[r][2]}; }
Vec3d columnOf(const Matrix& m, std::size_t c) { return {m[0][c], m[1][c], m[2][c]}; }

Matrix inverse(const Matrix& m) {
  const Vec3d a = rowOf(m, 0), b = rowOf(m, 1), c = rowOf(m, 2);
  const double scale = 1 / dot(a, cross(b, c));
  const Vec3d x = scale * cross(b, c), y = scale * cross(c, a), z = scale * cross(a, b);
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

// The direction in which v does not change, along the triangle; where it changes nowhere, that of the x or,
// in a triangle that looks that way, of the z axis.
Vec3d weftOf(const TriangleEdges& edges, Vec3d normal,
             const std::array<std::array<float, 2>, 3>& textureCoordinates) {
  constexpr double ROUNDING = 1e-6;  // of texture coordinates
  const auto v = [&](std::size_t corner) { return double{textureCoordinates[corner][1]}; };
  const double second = v(1) - v(0), third = v(2) - v(0);
  const bool isKnown = std::max(std::abs(second), std::abs(third)) > ROUNDING;
  const Vec3d axis = std::abs(normal.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
  const Vec3d weft = isKnown ? third * edges[2] + second * edges[1] : axis - dot(axis, normal) * normal;
  return (1 / length(weft)) * weft;
}

// R of B = Q R (Gram and Schmidt).
MembraneRoots rootsOf(const Matrix& b) {
  const Vec3d x = columnOf(b, 0), y = columnOf(b, 1), z = columnOf(b, 2);
  const double xx = length(x);
  const Vec3d p = (1 / xx) * x;
  const double xy = dot(p, y);
  const Vec3d y1 = y - xy * p;
  const double yy = length(y1);
  const Vec3d q = (1 / yy) * y1;
  const double xz = dot(p, z);
  const Vec3d z1 = z - xz * p;
  const double yz = dot(q, z1);
  return {xx, xy, xz, yy, yz, length(z1 - yz * q)};
}

std::array<double, 3> columnOf(const MembraneRoots& roots, std::size_t k) {
  std::array<double, 3> unit{};
  unit[k] = 1;
  return timesRoots(roots, unit);
}

// The strain (E11, E22, 2 E12) is A^-1 e, where row k of A is (D1^2, D2^2, D1 D2) of edge k; its energy
// 1/2 area |U A^-1 e|^2, with U^T U the matrix of the moduli.
MembraneRoots membraneOf(const TriangleEdges& edges, Vec3d weft, Vec3d warp, double area,
                         const SheetModuli& moduli) {
  Matrix a{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = dot(edges[k], weft), across = dot(edges[k], warp);
    a[k] = {along * along, across * across, along * across};
  }
  const Matrix strain = inverse(a);
  const double u11 = std::sqrt(moduli.c11), u12 = moduli.c12 / u11, u22 = std::sqrt(moduli.c22 - u12 * u12),
               u33 = std::sqrt(moduli.shear), root = std::sqrt(area);
  Matrix b{};
  for (std::size_t c = 0; c < 3; ++c)
    b[0][c] = root * (u11 * strain[0][c] + u12 * strain[1][c]), b[1][c] = root * u22 * strain[1][c],
    b[2][c] = root * u33 * strain[2][c];
  return rootsOf(b);
}

}  // namespace

TriangleEdges edgesOf(const std::array<std::uint32_t, 3>& corners, const std::vector<Vec3d>& points) {
  const Vec3d a = points[corners[0]], b = points[corners[1]], c = points[corners[2]];
  return {c - b, a - c, b - a};
}

std::vector<MembraneRoots> membranesOf(const MeshShape& shape, const std::vector<Vec3d>& points,
                                       const ClothSettings& cloth) {
  std::vector<MembraneRoots> membranes;
  membranes.reserve(shape.triangles.size());
  const SheetModuli moduli = sheetModuli(*cloth.material);
  for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
    const TriangleEdges edges = edgesOf(shape.triangles[t], points);
    const Vec3d twice = cross(edges[0], edges[1]);
    const Vec3d normal = (1 / length(twice)) * twice;
    const Vec3d weft = weftOf(edges, normal, shape.cornerCoordinates[t]);
    membranes.push_back(membraneOf(edges, weft, cross(normal, weft), 0.5 * length(twice), moduli));
  }
  return membranes;
}

std::array<double, 3> timesRoots(const MembraneRoots& roots, const std::array<double, 3>& e) {
  const auto& [xx, xy, xz, yy, yz, zz] = roots;
  return {xx * e[0] + xy * e[1] + xz * e[2], yy * e[1] + yz * e[2], zz * e[2]};
}

double stiffnessAlong(std::size_t k, const TriangleEdges& edges, const MembraneRoots& roots) {
  const std::array<double, 3> column = columnOf(roots, k);
  return (column[0] * column[0] + column[1] * column[1] + column[2] * column[2]) * dot(edges[k], edges[k]);
}

// The matrix is B^T B, where row r of B has g = R(r, k) D_k of the edges that meet at a corner; B B^T, of
// three rows, has the same largest eigenvalue, and no eigenvalue is beyond its largest sum of a row.
double membraneBound(const TriangleEdges& edges, const MembraneRoots& roots) {
  std::array<std::array<Vec3d, 3>, 3> rows;  // by row of R and corner
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<double, 3> column = columnOf(roots, k);
    for (std::size_t r = 0; r < 3; ++r) {
      Vec3d &from = rows[r][(k + 1) % 3], &to = rows[r][(k + 2) % 3];
      from = from - column[r] * edges[k];
      to = to + column[r] * edges[k];
    }
  }
  double largest = 0;
  for (const auto& row : rows) {
    double sum = 0;
    for (const auto& other : rows)
      sum += std::abs(dot(row[0], other[0]) + dot(row[1], other[1]) + dot(row[2], other[2]));
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace clothsim
