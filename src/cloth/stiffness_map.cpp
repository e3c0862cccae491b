#include "cloth/stiffness_map.h"

#include <algorithm>
#include <string>

#include "cloth/mesh_shape.h"
#include "cloth/pins.h"
#include "core/error.h"

namespace clothsim {
namespace {

double leastOf(const std::vector<double>& weights, std::initializer_list<std::uint32_t> points) {
  double least = 1;
  for (const std::uint32_t point : points) least = std::min(least, weights[point]);
  return least;
}

bool holdsTriangle(const std::vector<double>& weights, const MeshShape& shape) {
  return std::any_of(shape.triangles.begin(), shape.triangles.end(), [&](const MeshShape::Triangle& t) {
    return leastOf(weights, {t[0], t[1], t[2]}) > 0;
  });
}

// `triangles`: the least number of triangles beside the edge.
bool holdsEdge(const std::vector<double>& weights, const MeshShape& shape, int triangles) {
  return std::any_of(shape.edges.begin(), shape.edges.end(), [&](const MeshShape::Edge& edge) {
    return edge.triangles >= triangles && leastOf(weights, {edge.a, edge.b}) > 0;
  });
}

}  // namespace

StiffnessMap::StiffnessMap(const ClothSettings& cloth, const MeshShape& shape) {
  for (std::size_t i = 0; i < cloth.stiffnessMap.size(); ++i) {
    const auto& [points, stretch, bend] = cloth.stiffnessMap[i];
    const std::string key = "cloth.stiffness_map." + std::to_string(i);
    std::vector<double> weights = weightsOf(points, cloth, key + ".points");
    const auto fail = [&](const std::string& factor, const std::string& what) {
      throw SceneError(key + "." + factor + ": expected points that hold " + what +
                       " of the mesh, found none; name all vertices of the part, or leave the factor out (" +
                       cloth.mesh + ")");
    };
    if (stretch != 1 && !(cloth.material ? holdsTriangle(weights, shape) : holdsEdge(weights, shape, 1)))
      fail("stretch", cloth.material ? "all corners of some triangle" : "both ends of some edge");
    if (bend != 1 && !holdsEdge(weights, shape, 2))
      fail("bend", "both ends of some edge between two triangles");
    parts_.push_back({std::move(weights), stretch, bend});
  }
}

double StiffnessMap::stretchFactor(std::initializer_list<std::uint32_t> points) const {
  double factor = 1;
  for (const Part& part : parts_) factor *= 1 + leastOf(part.weights, points) * (part.stretch - 1);
  return factor;
}

double StiffnessMap::bendFactor(std::initializer_list<std::uint32_t> points) const {
  double factor = 1;
  for (const Part& part : parts_) factor *= 1 + leastOf(part.weights, points) * (part.bend - 1);
  return factor;
}

}  // namespace clothsim
