#include "scene/colliders/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/vector_clones.h"
#include "core/vector_set.h"

namespace clothsim {

namespace {

constexpr std::size_t LEAF_SIZE = 4;
// Of a tree that is halved at every node.
constexpr std::size_t MOST_DEPTH = 64;
constexpr std::size_t EIGHT = EightPlaces::EIGHT;
using Node = TriangleTree::Node;
using Triangle = TriangleTree::Triangle;
using Nearest = TriangleTree::Nearest;

INLINE double beyond(double low, double x, double high) {
  const double below = low - x, above = x - high, farther = below < above ? above : below;
  return farther < 0 ? 0 : farther;
}
INLINE double squaredTo(const Node& node, Vec3d p) {
  const Vec3d d{beyond(node.low.x, p.x, node.high.x), beyond(node.low.y, p.y, node.high.y),
                beyond(node.low.z, p.z, node.high.z)};
  return dot(d, d);
}
INLINE bool mayBeNearer(const Node& node, const EightPlaces& places, const Nearest& nearest) {
  long count = 0;
  for (std::size_t k = 0; k < EIGHT; ++k) count += squaredTo(node, places.at(k)) < nearest.squared[k] ? 1 : 0;
  return count > 0;
}

// Ericson's cases, of which the first that holds counts, from the last one on.
INLINE void meetTriangle(const Triangle& triangle, double number, const EightPlaces& places,
                         Nearest& nearest) {
  const auto [a, b, c] = triangle;
  const Vec3d ab = b - a, ac = c - a, bc = c - b;
#pragma GCC ivdep
  for (std::size_t k = 0; k < EIGHT; ++k) {
    const Vec3d p = places.at(k), ap = p - a, bp = p - b, cp = p - c;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
                 d6 = dot(ac, cp);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    // The point is from + (first along + second ac) / whole.
    Vec3d from = a, along = ab;
    double first = vb, second = vc, whole = va + vb + vc, part = 6;
    const auto choose = [&](bool holds, double otherPart, Vec3d otherFrom, Vec3d otherAlong,
                            double otherFirst, double otherWhole) __attribute__((always_inline)) {
      from = {holds ? otherFrom.x : from.x, holds ? otherFrom.y : from.y, holds ? otherFrom.z : from.z};
      along = {holds ? otherAlong.x : along.x, holds ? otherAlong.y : along.y,
               holds ? otherAlong.z : along.z};
      first = holds ? otherFirst : first;
      second = holds ? 0 : second;
      whole = holds ? otherWhole : whole;
      part = holds ? otherPart : part;
    };
    choose((vb <= 0) & (d2 >= 0) & (d6 <= 0), 5, a, ac, d2, d2 - d6);
    choose((va <= 0) & (d4 - d3 >= 0) & (d5 - d6 >= 0), 4, b, bc, d4 - d3, (d4 - d3) + (d5 - d6));
    choose((vc <= 0) & (d1 >= 0) & (d3 <= 0), 3, a, ab, d1, d1 - d3);
    choose((d6 >= 0) & (d5 <= d6), 2, c, ab, 0, 1);
    choose((d3 >= 0) & (d4 <= d3), 1, b, ab, 0, 1);
    choose((d1 <= 0) & (d2 <= 0), 0, a, ab, 0, 1);
    const Vec3d point = (from + (first / whole) * along) + (second / whole) * ac;
    const Vec3d away = p - point;
    const double squared = dot(away, away);
    const bool isNearer = squared < nearest.squared[k];
    nearest.squared[k] = isNearer ? squared : nearest.squared[k];
    nearest.triangles[k] = isNearer ? number : nearest.triangles[k];
    nearest.parts[k] = isNearer ? part : nearest.parts[k];
    nearest.points.x[k] = isNearer ? point.x : nearest.points.x[k];
    nearest.points.y[k] = isNearer ? point.y : nearest.points.y[k];
    nearest.points.z[k] = isNearer ? point.z : nearest.points.z[k];
  }
}

// The child whose box is nearer to the first place is looked at first.
INLINE void searchTree(const Node* nodes, const Triangle* triangles, const EightPlaces& places,
                       Nearest& nearest) {
  nearest = {};
  nearest.squared.fill(1e300);
  std::array<std::uint32_t, MOST_DEPTH> left;
  std::size_t waiting = 0;
  left[waiting++] = 0;
  while (waiting > 0) {
    const Node& node = nodes[left[--waiting]];
    if (!mayBeNearer(node, places, nearest)) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      meetTriangle(triangles[i], i, places, nearest);
    if (node.count > 0) continue;
    const Vec3d p = places.at(0);
    const bool isLeftNearer = squaredTo(nodes[node.left], p) < squaredTo(nodes[node.right], p);
    left[waiting++] = isLeftNearer ? node.right : node.left;
    left[waiting++] = isLeftNearer ? node.left : node.right;
  }
}
VECTOR_CLONES(void, search,
              (const Node* nodes, const Triangle* triangles, const EightPlaces& places, Nearest& nearest),
              (nodes, triangles, places, nearest), searchTree(nodes, triangles, places, nearest))

EightPlaces eightTimes(Vec3d p) {
  EightPlaces places;
  for (std::size_t k = 0; k < EIGHT; ++k) places.set(k, p);
  return places;
}

}  // namespace

TriangleTree::TriangleTree(const SolidMesh& mesh) : mesh_(&mesh), order_(mesh.triangles.size()) {
  (void)vectorSet();  // for its error, which may not come while threads search
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
  nodes_.reserve(2 * order_.size());
  build(0, order_.size());
  triangles_.reserve(order_.size());
  for (const std::uint32_t number : order_) triangles_.push_back(triangleAt(number));
  makePseudonormals();
}

EightPlaces::Numbers TriangleTree::signedDistances(const EightPlaces& places) const {
  Nearest nearest;
  search(nodes_.data(), triangles_.data(), places, nearest);
  EightPlaces::Numbers distances{};
  for (std::size_t k = 0; k < EIGHT; ++k) {
    const std::uint32_t triangle = order_[static_cast<std::size_t>(nearest.triangles[k])];
    const Vec3d normal = pseudonormals_[triangle][static_cast<std::size_t>(nearest.parts[k])];
    const double distance = std::sqrt(nearest.squared[k]);
    distances[k] = dot(places.at(k) - nearest.points.at(k), normal) < 0 ? -distance : distance;
  }
  return distances;
}
double TriangleTree::signedDistance(Vec3d p) const { return signedDistances(eightTimes(p))[0]; }

std::array<MeshPoint, EIGHT> TriangleTree::nearestPoints(const EightPlaces& places) const {
  Nearest nearest;
  search(nodes_.data(), triangles_.data(), places, nearest);
  std::array<MeshPoint, EIGHT> points;
  for (std::size_t k = 0; k < EIGHT; ++k) points[k] = meshPoint(nearest, k);
  return points;
}
MeshPoint TriangleTree::nearestPoint(Vec3d p) const { return nearestPoints(eightTimes(p))[0]; }

MeshPoint TriangleTree::meshPoint(const Nearest& nearest, std::size_t k) const {
  const std::uint32_t number = order_[static_cast<std::size_t>(nearest.triangles[k])];
  const auto [a, b, c] = triangleAt(number);
  const Vec3d ab = b - a, ac = c - a, ap = nearest.points.at(k) - a;
  const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), pb = dot(ap, ab), pc = dot(ap, ac);
  const double area = bb * cc - bc * bc;
  if (!(area > 0)) return {number, {1, 0, 0}};
  const double v = (cc * pb - bc * pc) / area, w = (bb * pc - bc * pb) / area;
  return {number, {1 - v - w, v, w}};
}

Triangle TriangleTree::triangleAt(std::size_t number) const {
  const SolidMesh::Triangle& t = mesh_->triangles[number];
  return {mesh_->points[t[0]], mesh_->points[t[1]], mesh_->points[t[2]]};
}

std::uint32_t TriangleTree::build(std::size_t first, std::size_t count) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  Node node{{1e300, 1e300, 1e300},
            {-1e300, -1e300, -1e300},
            static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(count)};
  for (std::size_t i = first; i < first + count; ++i) {
    const auto [a, b, c] = triangleAt(order_[i]);
    for (const Vec3d corner : {a, b, c}) {
      node.low = lowerCorner(node.low, corner);
      node.high = upperCorner(node.high, corner);
    }
  }
  nodes_.push_back(node);
  if (count <= LEAF_SIZE) return self;
  const Vec3d size = node.high - node.low;
  const auto key = [&](std::uint32_t triangle) {
    const auto [a, b, c] = triangleAt(triangle);
    const Vec3d middle = a + b + c;
    return size.x >= size.y && size.x >= size.z ? middle.x : size.y >= size.z ? middle.y : middle.z;
  };
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2),
                   begin + static_cast<std::ptrdiff_t>(count),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  const std::uint32_t left = build(first, count / 2), right = build(first + count / 2, count - count / 2);
  nodes_[self].count = 0;
  nodes_[self].left = left;
  nodes_[self].right = right;
  return self;
}

// Of corners: the triangles' normals weighted by their angles there (mesh_->normals); of edges: the sum of
// two.
void TriangleTree::makePseudonormals() {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> edges;
  pseudonormals_.resize(mesh_->triangles.size());
  for (std::size_t i = 0; i < mesh_->triangles.size(); ++i) {
    const auto [a, b, c] = triangleAt(i);
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
