// Colliders as drawn: one tessellated unit sphere for all spheres, one square for all planes, both placed by
// instance.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/vertex_array.h"

namespace clothsim {

// A sphere as drawn.
struct SpherePlace {
  glm::vec4 place;        // centre and drawn radius [m]
  glm::vec4 collider{0};  // x: its index in the scene
  glm::vec4 look{};       // linear colour and gloss
};

class SphereMesh {
 public:
  // @param around, down  segments along the equator (>= 3) and from pole to pole (>= 2)
  SphereMesh(int around, int down);
  void place(const std::vector<SpherePlace>& spheres);
  void draw() const;

 private:
  gl::Buffer<glm::vec3> points_;
  gl::Buffer<std::uint32_t> indices_;
  gl::Buffer<SpherePlace> instances_;
  gl::VertexArray vertices_;
  GLsizei count_ = 0;
};

// A plane's drawn part: a disc that fades out towards its edge.
struct PlaneDisc {
  glm::vec4 place;   // centre and radius [m]
  glm::vec4 normal;  // xyz, unit; w: index of the collider, -1: of none
  glm::vec4 look;    // linear colour and gloss; red below 0: the stage's ground
  friend bool operator==(const PlaneDisc&, const PlaneDisc&) = default;
};

class PlaneMesh {
 public:
  PlaneMesh();
  void place(const std::vector<PlaneDisc>& discs);  // in drawing order
  void draw(std::size_t first, std::size_t count) const;

 private:
  gl::Buffer<PlaneDisc> instances_;
  gl::VertexArray vertices_;
};

}  // namespace clothsim
