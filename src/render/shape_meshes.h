// Colliders that are drawn as meshes, all but spheres and planes: each in its own frame, all in one buffer,
// placed by three rows of a matrix.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/vertex_array.h"
#include "scene/colliders/collider_set.h"

namespace clothsim {

// Which shapes a body that deforms is between at `time` [s]; of what is rigid always the same.
[[nodiscard]] ShapeMoment momentOf(const Collider& collider, double time);

class ShapeMeshes {
 public:
  ShapeMeshes();
  // Builds the meshes of those colliders that are drawn by one, in the scene's order; cloth has triangles of
  // `longestEdge` [m].
  void build(const ColliderSet& colliders, double longestEdge);
  // Where they are at `time` [s], and in which shapes.
  void place(const ColliderSet& colliders, double time);
  void draw() const;

 private:
  struct Rows {
    glm::vec4 x, y, z;      // world from own frame
    glm::vec4 collider{0};  // x: its index in the scene
    glm::vec4 look{};       // linear colour and gloss
  };
  struct Part {
    std::size_t firstIndex, indexCount, collider, firstPoint;
    ShapeMoment moment;  // of a body that deforms, as its points are now
  };
  void reshape(Part& part, const ColliderSet& colliders, double time);

  double longestEdge_ = 0;
  std::vector<Part> parts_;
  gl::Buffer<Surface::Vertex> points_;
  gl::Buffer<std::uint32_t> indices_;
  gl::Buffer<Rows> instances_;
  gl::VertexArray vertices_;
};

}  // namespace clothsim
