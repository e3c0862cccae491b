#include "scene/colliders/signed_distance_grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/exact_math.h"
#include "core/recent.h"
#include "core/thread_team.h"
#include "scene/obj_file.h"

namespace clothsim {

namespace {
Vec3d normalized(Vec3d v) {
  const double l = length(v);
  return l > 0 ? (1 / l) * v : Vec3d{};
}
Vec3d lowest(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d highest(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

// Which part of a triangle is nearest: its corners 0 to 2, its edges 3 to 5 (edge 3 + i begins at corner i),
// or its inside, 6.
struct NearestPlace {
  Vec3d point;
  int part = 6;
};

NearestPlace nearestOnTriangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return {a, 0};
  if (d3 >= 0 && d4 <= d3) return {b, 1};
  if (d6 >= 0 && d5 <= d6) return {c, 2};
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + (d1 / (d1 - d3)) * ab, 3};
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return {b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b), 4};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + (d2 / (d2 - d6)) * ac, 5};
  const double sum = va + vb + vc;
  return {a + (vb / sum) * ab + (vc / sum) * ac, 6};
}

}  // namespace

// Triangles in a tree of bounding boxes, halved at the median of their middles.
class TriangleTree {
 public:
  explicit TriangleTree(const SolidMesh& mesh) : mesh_(&mesh), order_(mesh.triangles.size()) {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
    nodes_.reserve(2 * order_.size());
    build(0, order_.size());
    makePseudonormals();
  }

  [[nodiscard]] double signedDistance(Vec3d p) const {
    Best best;
    search(0, p, best);
    const Vec3d away = p - best.place.point;
    const double side = dot(away, pseudonormals_[best.triangle][static_cast<std::size_t>(best.place.part)]);
    const double distance = std::sqrt(best.squared);
    return side < 0 ? -distance : distance;
  }

 private:
  struct Node {
    Vec3d low, high;
    std::size_t first = 0, count = 0;  // of order_, in a leaf
    std::size_t left = 0, right = 0;   // nodes, elsewhere
  };
  struct Best {
    double squared = 1e300;
    std::size_t triangle = 0;
    NearestPlace place;
  };
  static constexpr std::size_t leafSize = 4;

  [[nodiscard]] std::array<Vec3d, 3> corners(std::size_t triangle) const {
    const SolidMesh::Triangle& t = mesh_->triangles[triangle];
    return {mesh_->points[t[0]], mesh_->points[t[1]], mesh_->points[t[2]]};
  }

  std::size_t build(std::size_t first, std::size_t count) {
    const std::size_t self = nodes_.size();
    Node node{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}, first, count};
    for (std::size_t i = first; i < first + count; ++i)
      for (const Vec3d corner : corners(order_[i])) {
        node.low = lowest(node.low, corner);
        node.high = highest(node.high, corner);
      }
    nodes_.push_back(node);
    if (count <= leafSize) return self;
    const Vec3d size = node.high - node.low;
    const auto key = [&](std::uint32_t triangle) {
      const auto [a, b, c] = corners(triangle);
      const Vec3d middle = a + b + c;
      return size.x >= size.y && size.x >= size.z ? middle.x : size.y >= size.z ? middle.y : middle.z;
    };
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2),
                     begin + static_cast<std::ptrdiff_t>(count),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    const std::size_t left = build(first, count / 2), right = build(first + count / 2, count - count / 2);
    nodes_[self].count = 0;
    nodes_[self].left = left;
    nodes_[self].right = right;
    return self;
  }

  [[nodiscard]] double squaredTo(const Node& node, Vec3d p) const {
    const Vec3d d = p - highest(node.low, lowest(p, node.high));
    return dot(d, d);
  }

  void search(std::size_t index, Vec3d p, Best& best) const {
    const Node& node = nodes_[index];
    if (node.count > 0) {
      for (std::size_t i = node.first; i < node.first + node.count; ++i) {
        const auto [a, b, c] = corners(order_[i]);
        const NearestPlace place = nearestOnTriangle(p, a, b, c);
        const double squared = dot(p - place.point, p - place.point);
        if (squared < best.squared) best = {squared, order_[i], place};
      }
      return;
    }
    const double left = squaredTo(nodes_[node.left], p), right = squaredTo(nodes_[node.right], p);
    const std::size_t nearer = left < right ? node.left : node.right;
    const std::size_t farther = left < right ? node.right : node.left;
    if (std::min(left, right) < best.squared) search(nearer, p, best);
    if (std::max(left, right) < best.squared) search(farther, p, best);
  }

  // Of corners: the triangles' normals weighted by their angles there (mesh_->normals); of edges: the sum of
  // two.
  void makePseudonormals() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> edges;
    pseudonormals_.resize(mesh_->triangles.size());
    for (std::size_t i = 0; i < mesh_->triangles.size(); ++i) {
      const auto [a, b, c] = corners(i);
      pseudonormals_[i][6] = normalized(cross(b - a, c - a));
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = mesh_->triangles[i][k], to = mesh_->triangles[i][(k + 1) % 3];
        Vec3d& sum = edges[std::minmax(from, to)];
        sum = sum + pseudonormals_[i][6];
      }
    }
    for (std::size_t i = 0; i < mesh_->triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = mesh_->triangles[i][k], to = mesh_->triangles[i][(k + 1) % 3];
        pseudonormals_[i][k] = mesh_->normals[from];
        pseudonormals_[i][3 + k] = edges[std::minmax(from, to)];
      }
  }

  const SolidMesh* mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::vector<std::array<Vec3d, 7>> pseudonormals_;
};

namespace {

struct GridBox {
  Vec3d low;
  double cell;
  std::array<std::uint32_t, 3> counts;
};

GridBox boxAround(const SolidMesh& mesh, int cells) {
  Vec3d low = mesh.points.front(), high = low;
  for (const Vec3d point : mesh.points) {
    low = lowest(low, point);
    high = highest(high, point);
  }
  const Vec3d size = high - low;
  const double cell = std::max({size.x, size.y, size.z}) / cells;
  // Two cells more on each side: one that the mesh may not reach, and one against rounding.
  const auto count = [&](double side) { return static_cast<std::uint32_t>(std::ceil(side / cell)) + 5; };
  return {low, cell, {count(size.x), count(size.y), count(size.z)}};
}

}  // namespace

std::size_t SignedDistanceGrid::sampleCount(const SolidMesh& mesh, int cells) {
  const GridBox box = boxAround(mesh, cells);
  return static_cast<std::size_t>(box.counts[0]) * box.counts[1] * box.counts[2];
}

SignedDistanceGrid::SignedDistanceGrid(SolidMesh mesh, int cells)
    : mesh_(std::move(mesh)), tree_(std::make_unique<TriangleTree>(mesh_)) {
  const GridBox box = boxAround(mesh_, cells);
  cell_ = box.cell;
  counts_ = box.counts;
  origin_ = box.low - 2 * cell_ * Vec3d{1, 1, 1};
  samples_.resize(static_cast<std::size_t>(counts_[0]) * counts_[1] * counts_[2]);
  const auto columns = static_cast<std::ptrdiff_t>(counts_[0]),
             rows = static_cast<std::ptrdiff_t>(counts_[1]), layers = static_cast<std::ptrdiff_t>(counts_[2]);
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(layers), 1, [&](std::uint32_t layer) {
    const std::ptrdiff_t z = layer;
    for (std::ptrdiff_t y = 0; y < rows; ++y)
      for (std::ptrdiff_t x = 0; x < columns; ++x) {
        const Vec3d place{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        samples_[static_cast<std::size_t>((z * rows + y) * columns + x)] =
            canonical(static_cast<float>(tree_->signedDistance(origin_ + cell_ * place)));
      }
  });
}

SignedDistanceGrid::~SignedDistanceGrid() = default;

double SignedDistanceGrid::distance(Vec3d p) const { return tree_->signedDistance(p); }

namespace {

// Points at the same place become one, since texture seams double them.
SolidMesh welded(const std::string& file, const tinyobj::attrib_t& attributes,
                 const std::vector<tinyobj::shape_t>& shapes, double scale) {
  SolidMesh mesh;
  std::map<std::array<double, 3>, std::uint32_t> known;
  for (const tinyobj::shape_t& shape : shapes)
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
      SolidMesh::Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = 3 * static_cast<std::size_t>(shape.mesh.indices[i + k].vertex_index);
        if (at + 2 >= attributes.vertices.size())
          throw SceneError(file + ": a face names a point that the file does not have");
        const Vec3d point =
            scale * Vec3d{attributes.vertices[at], attributes.vertices[at + 1], attributes.vertices[at + 2]};
        const auto [place, isNew] =
            known.try_emplace({point.x, point.y, point.z}, static_cast<std::uint32_t>(mesh.points.size()));
        if (isNew) mesh.points.push_back(point);
        triangle[k] = place->second;
      }
      const bool degenerate =
          triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
      if (!degenerate) mesh.triangles.push_back(triangle);
    }
  return mesh;
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
        normalized(cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d to = normalized(mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]]);
      const Vec3d from = normalized(mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]]);
      const double angle = std::acos(std::clamp(dot(to, from), -1.0, 1.0));
      mesh.normals[t[k]] = mesh.normals[t[k]] + angle * normal;
    }
  }
  for (Vec3d& normal : mesh.normals) normal = normalized(normal);
}

}  // namespace

SolidMesh loadSolidMesh(const std::string& file, double scale) {
  const ObjFile obj = readObjFile(file, "`file` of a mesh collider");
  SolidMesh mesh = welded(file, obj.attributes, obj.shapes, scale);
  if (mesh.triangles.empty()) throw SceneError(file + ": expected an OBJ file with faces, found none");
  for (const Vec3d& p : mesh.points)
    if (!std::isfinite(p.x + p.y + p.z)) throw SceneError(file + ": holds a point that is not finite");
  if (const std::size_t open = openEdges(mesh); open > 0)
    throw SceneError(file +
                     ": expected a closed surface, each edge between two faces of one orientation; found " +
                     std::to_string(open) +
                     " edges that are not. Close the holes and unify the normals in a modelling program.");
  if (volumeOf(mesh) < 0)
    for (SolidMesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  addNormals(mesh);
  return mesh;
}

namespace {

using GridKey = std::tuple<std::string, double, int>;  // file, scale, cells
GridKey keyOf(const MeshCollider& collider) { return {collider.file, collider.scale, collider.cells}; }

Recent<GridKey, SignedDistanceGrid>& knownGrids() {
  static Recent<GridKey, SignedDistanceGrid> grids(MOST_DISTANCE_SAMPLES);
  return grids;
}

[[noreturn]] void failForSamples(std::size_t place, std::size_t samples, std::size_t most) {
  throw SceneError("colliders." + std::to_string(place) +
                   ": with this one the meshes among the colliders need " + std::to_string(samples) +
                   " samples of distance, expected at most " + std::to_string(most) +
                   "; lower their `cells`, or use fewer of them");
}

}  // namespace

std::shared_ptr<const SignedDistanceGrid> distanceGridOf(const MeshCollider& collider) {
  if (auto grid = knownGrids().find(keyOf(collider))) return grid;
  auto grid = std::make_shared<const SignedDistanceGrid>(loadSolidMesh(collider.file, collider.scale),
                                                         collider.cells);
  knownGrids().add(keyOf(collider), grid, grid->samples().size());
  return grid;
}

DistanceGrids distanceGridsOf(std::span<const Collider> colliders, std::size_t most) {
  std::map<GridKey, std::size_t> sampleCounts;
  std::size_t samples = 0;
  for (std::size_t i = 0; i < colliders.size(); ++i)
    if (const auto* mesh = std::get_if<MeshCollider>(&colliders[i])) {
      const auto [known, isNew] = sampleCounts.try_emplace(keyOf(*mesh));
      if (isNew) {
        const auto grid = knownGrids().find(keyOf(*mesh));
        known->second =
            grid ? grid->samples().size()
                 : SignedDistanceGrid::sampleCount(loadSolidMesh(mesh->file, mesh->scale), mesh->cells);
      }
      samples += known->second;
      if (samples > most) failForSamples(i, samples, most);
    }
  DistanceGrids grids(colliders.size());
  for (std::size_t i = 0; i < colliders.size(); ++i)
    if (const auto* mesh = std::get_if<MeshCollider>(&colliders[i])) grids[i] = distanceGridOf(*mesh);
  return grids;
}

}  // namespace clothsim
