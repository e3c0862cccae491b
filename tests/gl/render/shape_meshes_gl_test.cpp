#include "render/shape_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "solver/cpu/shapes.h"

namespace clothsim {
namespace {

const std::vector<Collider> shapes{
    Capsule{.length = 0.4, .radius = 0.1}, Box{.size = {0.5, 0.3, 0.7}, .rounding = 0.03},
    Box{.size = {0.4, 0.4, 0.002}, .rounding = 0}, Torus{.radius = 0.3, .tubeRadius = 0.1}};

double distanceTo(const Collider& collider, Vec3d p) {
  const auto params = makeColliderParams<double>(Scene{}, collider, 0, 0);
  switch (params.type) {
    case COLLIDER_CAPSULE:
      return cpu::nearestOnShape<COLLIDER_CAPSULE>(params, p).distance;
    case COLLIDER_BOX:
      return cpu::nearestOnShape<COLLIDER_BOX>(params, p).distance;
    default:
      return cpu::nearestOnShape<COLLIDER_TORUS>(params, p).distance;
  }
}

TEST(DrawnSurface, LiesALittleInsideTheShape) {
  for (const Collider& collider : shapes)
    for (const ShapeSurface::Vertex& vertex : drawnSurface(collider, 0.01).vertices) {
      const double distance =
          distanceTo(collider, Vec3f{vertex.position.x, vertex.position.y, vertex.position.z}.cast<double>());
      EXPECT_LT(distance, 0) << collider.index();
      EXPECT_GT(distance, -0.012) << collider.index();
    }
}

TEST(DrawnSurface, IsClosedWithTrianglesThatFaceOutwards) {
  for (const Collider& collider : shapes) {
    const ShapeSurface surface = drawnSurface(collider, 0.01);
    ASSERT_EQ(surface.indices.size() % 3, 0u);
    using Place = std::tuple<long, long, long>;
    // Corners less than a micrometre apart are one.
    const auto place = [](glm::vec3 p) {
      return Place{std::lround(1e6f * p.x), std::lround(1e6f * p.y), std::lround(1e6f * p.z)};
    };
    std::map<std::pair<Place, Place>, int> edges;
    double volume = 0;
    for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
      const ShapeSurface::Vertex& a = surface.vertices[surface.indices[i]];
      const ShapeSurface::Vertex& b = surface.vertices[surface.indices[i + 1]];
      const ShapeSurface::Vertex& c = surface.vertices[surface.indices[i + 2]];
      const glm::vec3 normal = glm::cross(b.position - a.position, c.position - a.position);
      volume += static_cast<double>(glm::dot(a.position, normal)) / 6;
      if (glm::length(normal) > 1e-7f) {
        EXPECT_GT(glm::dot(normal, a.normal + b.normal + c.normal), 0) << collider.index();
      }
      const Place pa = place(a.position), pb = place(b.position), pc = place(c.position);
      for (const auto& [from, to] : {std::pair{pa, pb}, {pb, pc}, {pc, pa}}) {
        if (from == to) continue;
        ++edges[{from, to}];
        --edges[{to, from}];
      }
    }
    EXPECT_GT(volume, 0);
    int open = 0;
    for (const auto& [edge, balance] : edges) open += balance != 0;
    EXPECT_EQ(open, 0) << collider.index();
  }
}

}  // namespace
}  // namespace clothsim
