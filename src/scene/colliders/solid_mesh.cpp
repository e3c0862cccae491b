#include "scene/colliders/solid_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "scene/colliders/mesh_collider.h"
#include "scene/obj_file.h"

namespace clothsim {

namespace {

// As the file has it.
struct FileMesh {
  std::vector<Vec3d> points;
  std::vector<SolidMesh::Triangle> triangles;
};

FileMesh readMesh(const std::string& file, const std::string& use, double scale) {
  const ObjFile obj = readObjFile(file, use);
  const auto& numbers = obj.attributes.vertices;
  FileMesh mesh;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    mesh.points.push_back(scale * Vec3d{numbers[i], numbers[i + 1], numbers[i + 2]});
  for (const tinyobj::shape_t& shape : obj.shapes)
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
      SolidMesh::Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k)
        triangle[k] = static_cast<std::uint32_t>(shape.mesh.indices[i + k].vertex_index);
      mesh.triangles.push_back(triangle);
    }
  return mesh;
}

void checkFinite(const std::string& file, const FileMesh& mesh) {
  if (mesh.triangles.empty()) throw SceneError(file + ": expected an OBJ file with faces, found none");
  for (const SolidMesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t point : triangle)
      if (const Vec3d p = mesh.points[point]; !std::isfinite(p.x + p.y + p.z))
        throw SceneError(file + ": holds a point that is not finite");
}

// Points at the same place become one, since texture seams double them.
struct Welded {
  std::vector<std::uint32_t> kept;  // of the file's points
  std::vector<SolidMesh::Triangle> triangles;
};
Welded weld(const FileMesh& mesh) {
  Welded welded;
  std::map<std::array<double, 3>, std::uint32_t> known;
  for (SolidMesh::Triangle triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      const Vec3d point = mesh.points[corner];
      const auto [place, isNew] =
          known.try_emplace({point.x, point.y, point.z}, static_cast<std::uint32_t>(welded.kept.size()));
      if (isNew) welded.kept.push_back(corner);
      corner = place->second;
    }
    const bool degenerate =
        triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (!degenerate) welded.triangles.push_back(triangle);
  }
  return welded;
}

// How many edges are not shared by two triangles that go along them in opposite directions.
std::size_t openEdges(const SolidMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directions;
  for (const SolidMesh::Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++directions[{t[k], t[(k + 1) % 3]}];
  std::size_t open = 0;
  for (const auto& [edge, count] : directions) {
    const auto back = directions.find({edge.second, edge.first});
    open += count != 1 || back == directions.end() || back->second != 1;
  }
  return open;
}

double volumeOf(const SolidMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c])) / 6;
  return volume;
}

void addNormals(SolidMesh& mesh) {
  mesh.normals.assign(mesh.points.size(), Vec3d{});
  for (const SolidMesh::Triangle& t : mesh.triangles) {
    const Vec3d normal =
        unitVector(cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d to = unitVector(mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]]);
      const Vec3d from = unitVector(mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]]);
      const double angle = std::acos(std::clamp(dot(to, from), -1.0, 1.0));
      mesh.normals[t[k]] = mesh.normals[t[k]] + angle * normal;
    }
  }
  for (Vec3d& normal : mesh.normals) normal = unitVector(normal);
}

void checkClosed(const std::string& file, const SolidMesh& mesh) {
  if (const std::size_t open = openEdges(mesh); open > 0)
    throw SceneError(file +
                     ": expected a closed surface, each edge between two faces of one orientation; found " +
                     std::to_string(open) +
                     " edges that are not. Close the holes and unify the normals in a modelling program.");
}

void checkSameTriangles(const std::string& file, const FileMesh& mesh, const std::string& firstFile,
                        const FileMesh& first) {
  const auto sizes = [](const FileMesh& of) {
    return std::to_string(of.points.size()) + " points and " + std::to_string(of.triangles.size()) +
           " triangles";
  };
  if (mesh.points.size() != first.points.size() || mesh.triangles.size() != first.triangles.size())
    throw SceneError(file + ": expected " + sizes(first) + " as in " + firstFile + ", found " + sizes(mesh) +
                     "; the shapes of a body differ in the places of their points alone");
  if (mesh.triangles != first.triangles)
    throw SceneError(file + ": expected the faces of " + firstFile + " in the same order, found others" +
                     "; the shapes of a body differ in the places of their points alone");
}

SolidMesh shapeOf(const FileMesh& mesh, const Welded& welded) {
  SolidMesh shape;
  for (const std::uint32_t point : welded.kept) shape.points.push_back(mesh.points[point]);
  shape.triangles = welded.triangles;
  return shape;
}

std::vector<SolidMesh> shapesOf(const std::vector<std::string>& files, double scale) {
  std::vector<SolidMesh> shapes;
  FileMesh first;
  Welded welded;
  for (const std::string& file : files) {
    std::string use = "`file` of a mesh collider";
    if (files.size() > 1)
      use += ", shape " + std::to_string(shapes.size() + 1) + " of " + std::to_string(files.size()) + ",";
    FileMesh mesh = readMesh(file, use, scale);
    checkFinite(file, mesh);
    if (shapes.empty()) {
      welded = weld(mesh);
      if (welded.triangles.empty()) throw SceneError(file + ": expected faces with an area, found none");
      first = mesh;
    } else {
      checkSameTriangles(file, mesh, files.front(), first);
    }
    shapes.push_back(shapeOf(mesh, welded));
  }
  checkClosed(files.front(), shapes.front());
  const bool isInsideOut = volumeOf(shapes.front()) < 0;
  for (SolidMesh& shape : shapes) {
    if (isInsideOut)
      for (SolidMesh::Triangle& triangle : shape.triangles) std::swap(triangle[1], triangle[2]);
    addNormals(shape);
  }
  return shapes;
}

}  // namespace

Vec3d placeOf(const SolidMesh& mesh, const MeshPoint& point) {
  const auto& [a, b, c] = mesh.triangles[point.triangle];
  return (point.weights[0] * mesh.points[a] + point.weights[1] * mesh.points[b]) +
         point.weights[2] * mesh.points[c];
}

SolidMesh loadSolidMesh(const std::string& file, double scale) {
  return std::move(shapesOf({file}, scale).front());
}

std::vector<SolidMesh> loadShapes(const MeshCollider& collider) {
  std::vector<std::string> files;
  for (int shape = 0; shape < collider.shapes; ++shape) files.push_back(collider.fileOf(shape));
  return shapesOf(files, collider.scale);
}

SolidMesh between(const SolidMesh& a, const SolidMesh& b, double part) {
  SolidMesh mesh{.points = a.points, .normals = {}, .triangles = a.triangles};
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    mesh.points[i] = mesh.points[i] + part * (b.points[i] - a.points[i]);
  addNormals(mesh);
  return mesh;
}

Vec3d lowerCorner(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d upperCorner(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
Vec3d unitVector(Vec3d v) {
  const double l = length(v);
  return l > 0 ? (1 / l) * v : Vec3d{};
}

}  // namespace clothsim
