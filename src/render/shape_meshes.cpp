#include "render/shape_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "cloth/signed_distance_grid.h"
#include "render/collider_meshes.h"
#include "scene/pose.h"
#include "shared/render_layout.h"

namespace clothsim {
namespace {

constexpr int quarterSegments = 16;  // of a quarter turn

glm::vec3 glmOf(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// Rows and columns of points that go around and close; the two triangles of a cell each.
void addCells(ShapeSurface& surface, int rows, int columns, bool closeRows) {
  const auto index = [&](int row, int column) {
    return static_cast<std::uint32_t>((row % rows) * columns + column % columns);
  };
  for (int row = 0; row < (closeRows ? rows : rows - 1); ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = index(row, column), b = index(row, column + 1);
      const std::uint32_t c = index(row + 1, column), d = index(row + 1, column + 1);
      surface.indices.insert(surface.indices.end(), {a, c, b, b, c, d});
    }
}

// A sphere whose eight octants were pulled apart by `half` in each direction: a rounded box; along y alone a
// capsule. Points where octants meet are there twice, and the cells between them are edges and faces.
ShapeSurface pulledApart(double halfX, double halfY, double halfZ, double radius) {
  ShapeSurface surface;
  constexpr int n = quarterSegments;
  for (int row = 0; row < 2 * (n + 1); ++row) {
    const bool upper = row <= n;
    const double polar = 0.5 * std::numbers::pi * (upper ? row : row - 1) / n;
    for (int quarter = 0; quarter < 4; ++quarter)
      for (int i = 0; i <= n; ++i) {
        const double azimuth = 0.5 * std::numbers::pi * (quarter + static_cast<double>(i) / n);
        const double sideX = quarter < 2 ? 1 : -1, sideZ = quarter == 0 || quarter == 3 ? 1 : -1;
        const glm::vec3 normal =
            glmOf(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
        const glm::vec3 corner = glmOf(sideX * halfX, upper ? halfY : -halfY, sideZ * halfZ);
        surface.vertices.push_back({corner + static_cast<float>(radius) * normal, normal});
      }
  }
  constexpr int columns = 4 * (n + 1), rows = 2 * (n + 1);
  addCells(surface, rows, columns, false);
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

ShapeSurface surfaceOf(const Sphere&, double) { return {}; }
ShapeSurface surfaceOf(const Plane&, double) { return {}; }

ShapeSurface surfaceOf(const Capsule& capsule, double longestEdge) {
  const double radius = capsule.radius - sphereShrink(capsule.radius, longestEdge);
  return pulledApart(0, 0.5 * capsule.length, 0, radius);
}

// Cloth of edge length L bent around a sharp right angle cuts it off by L / 2 at most; a rounding of radius r
// gives way by (sqrt(2) - 1) r.
ShapeSurface surfaceOf(const Box& box, double longestEdge) {
  const double smallest = std::min({box.size.x, box.size.y, box.size.z});
  const double inset = std::min(0.003 * smallest + 0.05 * longestEdge, 0.1 * smallest);
  const double radius = std::min(box.rounding + 1.2 * longestEdge, 0.45 * smallest);
  const auto half = [&](double size) { return std::max(0.5 * size - inset - radius, 0.0); };
  return pulledApart(half(box.size.x), half(box.size.y), half(box.size.z), radius);
}

ShapeSurface surfaceOf(const Torus& torus, double longestEdge) {
  const double tube = torus.tubeRadius - sphereShrink(torus.tubeRadius, longestEdge);
  constexpr int around = 8 * quarterSegments, tubeSegments = 4 * quarterSegments;
  ShapeSurface surface;
  for (int row = 0; row < tubeSegments; ++row) {
    const double b = -2 * std::numbers::pi * row / tubeSegments;
    for (int column = 0; column < around; ++column) {
      const double a = 2 * std::numbers::pi * column / around;
      const glm::vec3 normal = glmOf(std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a));
      const glm::vec3 ring = glmOf(torus.radius * std::sin(a), 0, torus.radius * std::cos(a));
      surface.vertices.push_back({ring + static_cast<float>(tube) * normal, normal});
    }
  }
  addCells(surface, tubeSegments, around, true);
  return surface;
}

// Moved inwards along the points' normals by what keeps it apart from the cloth in the depth buffer.
ShapeSurface surfaceOf(const MeshCollider& collider, double longestEdge) {
  const auto grid = distanceGridOf(collider);
  const SolidMesh& mesh = grid->mesh();
  const double inset = std::min(0.15 * grid->cell() + 0.05 * longestEdge, grid->cell());
  ShapeSurface surface;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3d p = mesh.points[i] - inset * mesh.normals[i], n = mesh.normals[i];
    surface.vertices.push_back({glmOf(p.x, p.y, p.z), glmOf(n.x, n.y, n.z)});
  }
  for (const SolidMesh::Triangle& t : mesh.triangles)
    surface.indices.insert(surface.indices.end(), t.begin(), t.end());
  return surface;
}

}  // namespace

ShapeSurface drawnSurface(const Collider& collider, double longestEdge) {
  return std::visit([&](const auto& shape) { return surfaceOf(shape, longestEdge); }, collider);
}

ShapeMeshes::ShapeMeshes() : vertices_("shapes") {}

void ShapeMeshes::build(const std::vector<Collider>& colliders, double longestEdge) {
  std::vector<ShapeSurface::Vertex> points;
  std::vector<std::uint32_t> indices;
  parts_.clear();
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const ShapeSurface surface = drawnSurface(colliders[i], longestEdge);
    if (surface.indices.empty()) continue;
    parts_.push_back({indices.size(), surface.indices.size(), i});
    for (const std::uint32_t index : surface.indices)
      indices.push_back(index + static_cast<std::uint32_t>(points.size()));
    points.insert(points.end(), surface.vertices.begin(), surface.vertices.end());
  }
  if (parts_.empty()) return;
  points_ = gl::Buffer<ShapeSurface::Vertex>("shape points", std::span<const ShapeSurface::Vertex>(points));
  indices_ = gl::Buffer<std::uint32_t>("shape indices", std::span<const std::uint32_t>(indices));
  if (instances_.size() != parts_.size()) instances_ = gl::Buffer<Rows>("shape places", parts_.size());
  constexpr GLsizei stride = sizeof(ShapeSurface::Vertex);
  vertices_.attach(points_.name(), {.location = POSITION_LOCATION, .components = 3, .stride = stride});
  vertices_.attach(points_.name(), {.location = NORMAL_LOCATION,
                                    .components = 3,
                                    .stride = stride,
                                    .offset = offsetof(ShapeSurface::Vertex, normal)});
  vertices_.attachIndices(indices_.name());
  for (GLuint row = 0; row < 3; ++row)
    vertices_.attach(instances_.name(), {.location = INSTANCE_ROWS_LOCATION + row,
                                         .stride = sizeof(Rows),
                                         .offset = row * 16,
                                         .perInstance = true});
  vertices_.attach(instances_.name(), {.location = INSTANCE_COLLIDER_LOCATION,
                                       .components = 1,
                                       .stride = sizeof(Rows),
                                       .offset = offsetof(Rows, collider),
                                       .perInstance = true});
}

void ShapeMeshes::place(const std::vector<Collider>& colliders, double time) {
  std::vector<Rows> rows;
  for (const Part& part : parts_) {
    const Collider& collider = colliders[part.collider];
    const Pose pose = poseAt(collider, time);
    const Matrix3 r = product(pose.rotation, ownRotation(collider));
    const auto row = [&](Vec3d axis, double place) {
      return glm::vec4(glmOf(axis.x, axis.y, axis.z), static_cast<float>(place));
    };
    rows.push_back({row(r[0], pose.position.x), row(r[1], pose.position.y), row(r[2], pose.position.z),
                    glm::vec4(static_cast<float>(part.collider))});
  }
  if (!rows.empty()) instances_.upload(rows);
}

void ShapeMeshes::draw() const {
  if (parts_.empty()) return;
  vertices_.bind();
  for (std::size_t i = 0; i < parts_.size(); ++i)
    glDrawElementsInstancedBaseInstance(
        GL_TRIANGLES, static_cast<GLsizei>(parts_[i].indexCount), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(parts_[i].firstIndex * sizeof(std::uint32_t)), 1,
        static_cast<GLuint>(i));
}

}  // namespace clothsim
