#include "scene/colliders/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace clothsim {

namespace {

constexpr std::size_t LEAF_SIZE = 4;

}  // namespace

TriangleTree::NearestPlace TriangleTree::nearestOnTriangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
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

TriangleTree::TriangleTree(const SolidMesh& mesh) : mesh_(&mesh), order_(mesh.triangles.size()) {
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
  nodes_.reserve(2 * order_.size());
  build(0, order_.size());
  makePseudonormals();
}

double TriangleTree::signedDistance(Vec3d p, double bound) const {
  Best best{.squared = bound * bound, .place = {}};
  search(0, p, best);
  const Vec3d away = p - best.place.point;
  const double side = dot(away, pseudonormals_[best.triangle][static_cast<std::size_t>(best.place.part)]);
  const double distance = std::sqrt(best.squared);
  return side < 0 ? -distance : distance;
}

MeshPoint TriangleTree::nearestPoint(Vec3d p, double bound) const {
  Best best{.squared = bound * bound, .place = {}};
  search(0, p, best);
  const auto [a, b, c] = corners(best.triangle);
  const Vec3d ab = b - a, ac = c - a, ap = best.place.point - a;
  const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), pb = dot(ap, ab), pc = dot(ap, ac);
  const double area = bb * cc - bc * bc;
  if (!(area > 0)) return {best.triangle, {1, 0, 0}};
  const double v = (cc * pb - bc * pc) / area, w = (bb * pc - bc * pb) / area;
  return {best.triangle, {1 - v - w, v, w}};
}

std::array<Vec3d, 3> TriangleTree::corners(std::size_t triangle) const {
  const SolidMesh::Triangle& t = mesh_->triangles[triangle];
  return {mesh_->points[t[0]], mesh_->points[t[1]], mesh_->points[t[2]]};
}

std::size_t TriangleTree::build(std::size_t first, std::size_t count) {
  const std::size_t self = nodes_.size();
  Node node{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}, first, count};
  for (std::size_t i = first; i < first + count; ++i)
    for (const Vec3d corner : corners(order_[i])) {
      node.low = lowerCorner(node.low, corner);
      node.high = upperCorner(node.high, corner);
    }
  nodes_.push_back(node);
  if (count <= LEAF_SIZE) return self;
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

double TriangleTree::squaredTo(const Node& node, Vec3d p) {
  const auto beyond = [](double low, double x, double high) {
    return x < low ? low - x : high < x ? x - high : 0;
  };
  const Vec3d d{beyond(node.low.x, p.x, node.high.x), beyond(node.low.y, p.y, node.high.y),
                beyond(node.low.z, p.z, node.high.z)};
  return dot(d, d);
}

void TriangleTree::search(std::size_t index, Vec3d p, Best& best) const {
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
void TriangleTree::makePseudonormals() {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> edges;
  pseudonormals_.resize(mesh_->triangles.size());
  for (std::size_t i = 0; i < mesh_->triangles.size(); ++i) {
    const auto [a, b, c] = corners(i);
    pseudonormals_[i][6] = unitVector(cross(b - a, c - a));
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

}  // namespace clothsim
