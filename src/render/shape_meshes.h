// Capsules, boxes and tori as drawn: a mesh each in its own frame, all in one buffer, placed by three rows of
// a matrix.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/vertex_array.h"
#include "scene/scene.h"

namespace clothsim {

// The surface of a shape in its own frame; triangles are counter-clockwise from outside.
struct ShapeSurface {
  struct Vertex {
    glm::vec3 position, normal;
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

// Empty for spheres and planes, which have meshes of their own. Drawn a little smaller than it is, and a box
// with rounder edges, so that cloth with triangles of `longestEdge` [m] does not dip below.
[[nodiscard]] ShapeSurface drawnSurface(const Collider& collider, double longestEdge);

class ShapeMeshes {
 public:
  ShapeMeshes();
  // Builds the meshes of those colliders that need one, in the scene's order.
  void build(const std::vector<Collider>& colliders, double longestEdge);
  // Where they are at `time` [s].
  void place(const std::vector<Collider>& colliders, double time);
  void draw() const;

 private:
  struct Rows {
    glm::vec4 x, y, z;      // world from own frame
    glm::vec4 collider{0};  // x: its index in the scene
  };
  struct Part {
    std::size_t firstIndex, indexCount, collider;
  };
  std::vector<Part> parts_;
  gl::Buffer<ShapeSurface::Vertex> points_;
  gl::Buffer<std::uint32_t> indices_;
  gl::Buffer<Rows> instances_;
  gl::VertexArray vertices_;
};

}  // namespace clothsim
