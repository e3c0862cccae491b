#include "scene/colliders/sampled_mesh.h"

#include <algorithm>

#include "scene/colliders/surface.h"

namespace clothsim {

// Moved inwards along the points' normals by what keeps it apart from the cloth in the depth buffer.
Surface SampledMesh::surface(double longestEdge) const {
  const SolidMesh mesh = grid.shapes().size() == 1
                             ? grid.mesh()
                             : between(grid.shapes()[moment.from], grid.shapes()[moment.to], moment.part);
  const double inset = longestEdge > 0 ? std::min(0.15 * grid.cell() + 0.05 * longestEdge, grid.cell()) : 0;
  Surface surface;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    surface.vertices.push_back(
        {(mesh.points[i] - inset * mesh.normals[i]).cast<float>(), mesh.normals[i].cast<float>()});
  for (const SolidMesh::Triangle& t : mesh.triangles)
    surface.indices.insert(surface.indices.end(), t.begin(), t.end());
  return surface;
}

// To either side of the origin alike, for all shapes.
Vec3d SampledMesh::halfExtent(const Matrix3& rotation) const {
  Vec3d half;
  for (const SolidMesh& shape : grid.shapes())
    for (const Vec3d& point : shape.points) half = upperCorner(half, magnitude(rotate(rotation, point)));
  return half;
}

}  // namespace clothsim
