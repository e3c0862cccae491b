// The shape of a cloth that is no grid, as its OBJ file has it: points, triangles, the edges between them,
// and groups. Read and checked once for each file; what springs and masses follow from it is in cloth.h.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cloth/membrane.h"
#include "scene/scene.h"

namespace clothsim {

struct MeshShape {
  using Triangle = std::array<std::uint32_t, 3>;
  // An edge of one or two triangles. b < a; seen from a to b the first triangle lies to the left.
  struct Edge {
    std::uint32_t a = 0, b = 0;
    std::array<std::uint32_t, 2> opposite{};  // the third corners; `triangles` of them
    int triangles = 0;
    std::array<std::uint32_t, 2> beside{};  // their numbers; of a single one twice
  };

  std::vector<Vec3d> points;  // in units of the file
  // u and v of each point: those of the first corner there that has any; where the file has none, the place
  // in the box around the mesh, seen along its shortest side, v downwards.
  std::vector<std::array<float, 2>> textureCoordinates;
  std::vector<std::array<float, 3>> colors;  // r, g, b of each point; empty where some point has none
  std::vector<Triangle> triangles;           // polygons are split
  // Of each triangle those of its corners, which may differ from its points' at a seam of the texture.
  std::vector<std::array<std::array<float, 2>, 3>> cornerCoordinates;
  std::vector<Edge> edges;                                   // ascending in (a, b)
  std::map<std::string, std::vector<std::uint32_t>> groups;  // points of the faces of each, ascending

  // Points of the file that belong to no face are left out here. Scenes name the others as the file counts
  // them, from 0.
  std::size_t loosePoints = 0;
  std::vector<std::uint32_t> fileIndices;  // of the points, ascending; empty where none is left out
  [[nodiscard]] std::uint32_t fileIndexOf(std::uint32_t point) const {
    return fileIndices.empty() ? point : fileIndices[point];
  }
  [[nodiscard]] std::optional<std::uint32_t> pointAt(std::uint32_t fileIndex) const;  // none: left out
};

// Reads the OBJ file of a cloth, and reads it again only when it has changed. `file`: a path, or one below
// the resource root. Vertices are those of the file (`v`): corners that differ in texture coordinates or
// normals alone are one. @throws SceneError when it cannot be read, has no faces, a number that is none, a
// corner that is no vertex, a triangle without area or one that is there twice, or an edge with more than two
// triangles or with two of opposite orientation
[[nodiscard]] std::shared_ptr<const MeshShape> meshShapeOf(const std::string& file);

// The points of a mesh where the scene puts them at the start: scaled, rotated, translated [m].
[[nodiscard]] std::vector<Vec3d> placedPoints(const MeshShape& shape, const ClothSettings& cloth);

// Stiffness, masses and bending of a mesh from what its cloth is made of, in the order of edges or points.
struct MeshMechanics {
  std::vector<double> masses;  // [kg]: a third of each triangle around the point
  // Along each edge [N/m]: of its spring, or of the membrane while the other edges keep their lengths.
  std::vector<double> stretch;
  std::vector<MembraneRoots> membranes;  // of each triangle; empty without a material or structural springs
  std::vector<double> across;            // of the spring across each edge [N/m]; 0: none
  // Of the energy 1/2 |sum c_i x_i|^2 across each inner edge: the coefficients c of its ends a and b and of
  // the corners opposite [sqrt(N/m)]. Empty without a material.
  std::vector<std::array<double, 4>> bending;
};
// All of it times what the cloth's stiffness map says (cloth/stiffness_map.h); @throws SceneError where that
// names what the mesh does not have.
//
// Of `ks`: ks along edges, 0.2 ks across; of `stiffness_reference` that times reference_length over the
// length.
//
// Of a material: a membrane with its moduli (cloth/membrane.h). Bending is isometric (M. Bergou et al., "A
// quadratic bending model for inextensible surfaces", 2006): with the cotangents K of an edge's angles, 1/2 B
// / (A1 + A2) |K x|^2. Their factor is 3 times ours: on equilateral triangles ours is that of Seung and
// Nelson (1988), B = sqrt(3)/2 kappa, and bends a cylinder with 1/2 B / r^2 an area.
[[nodiscard]] MeshMechanics mechanicsOf(const MeshShape& shape, const std::vector<Vec3d>& points,
                                        const ClothSettings& cloth);

}  // namespace clothsim
