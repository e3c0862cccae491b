#include "render/shape_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "scene/colliders/collider_set.h"

namespace clothsim {
namespace {

const std::vector<Collider> shapes{Capsule{.length = 0.4, .radius = 0.1},
                                   Box{.size = {0.5, 0.3, 0.7}, .rounding = 0.03},
                                   Box{.size = {0.4, 0.4, 0.002}, .rounding = 0},
                                   Torus{.radius = 0.3, .tubeRadius = 0.1},
                                   Cylinder{.height = 0.4, .radius = 0.2},
                                   Cone{.height = 0.4, .radius = 0.2},
                                   Cone{.height = 0.3, .radius = 0.1, .topRadius = 0.2}};

ColliderSet only(const Collider& collider) {
  Scene scene;
  scene.colliders = {collider};
  return ColliderSet(scene);
}

TEST(DrawnSurface, LiesALittleInsideTheShape) {
  for (const Collider& collider : shapes) {
    const ColliderSet set = only(collider);
    for (const Surface::Vertex& vertex : set.drawnSurface(0, 0.01).vertices) {
      const double distance = set.distance(0, vertex.position.cast<double>());
      EXPECT_LT(distance, 0) << collider.index();
      EXPECT_GT(distance, -0.012) << collider.index();
    }
  }
}

TEST(DrawnSurface, IsClosedWithTrianglesThatFaceOutwards) {
  for (const Collider& collider : shapes) {
    const Surface surface = only(collider).drawnSurface(0, 0.01);
    ASSERT_EQ(surface.indices.size() % 3, 0u);
    using Place = std::tuple<long, long, long>;
    // Corners less than a micrometre apart are one.
    const auto place = [](Vec3f p) {
      return Place{std::lround(1e6f * p.x), std::lround(1e6f * p.y), std::lround(1e6f * p.z)};
    };
    std::map<std::pair<Place, Place>, int> edges;
    double volume = 0;
    for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
      const Surface::Vertex& a = surface.vertices[surface.indices[i]];
      const Surface::Vertex& b = surface.vertices[surface.indices[i + 1]];
      const Surface::Vertex& c = surface.vertices[surface.indices[i + 2]];
      const Vec3f normal = cross(b.position - a.position, c.position - a.position);
      volume += static_cast<double>(dot(a.position, normal)) / 6;
      if (std::sqrt(dot(normal, normal)) > 1e-7f) {
        EXPECT_GT(dot(normal, a.normal + b.normal + c.normal), 0) << collider.index();
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
