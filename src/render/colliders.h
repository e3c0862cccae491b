// All colliders of a scene as drawn, and the floor that a scene without one gets.
#pragma once

#include "gl/program.h"
#include "render/collider_meshes.h"
#include "render/shape_meshes.h"
#include "render/stage.h"
#include "scene/scene.h"

namespace clothsim {

class Colliders {
 public:
  // @param longestEdge  the longest side of the cloth's triangles [m], for which solids are drawn smaller
  Colliders(int sphereSegmentsAround, int sphereSegmentsDown, double longestEdge)
      : longestEdge_(longestEdge), spheres_(sphereSegmentsAround, sphereSegmentsDown) {}

  void build(const Scene& scene);
  // Where those of the scene that was built are at `time` [s].
  void place(const Scene& scene, const Stage& stage, double time);

  // As place() has put them: numbers that differ when a solid or a plane is seen elsewhere,
  [[nodiscard]] const std::vector<glm::vec4>& places() const { return places_; }
  // boxes around the solids,
  [[nodiscard]] const std::vector<Bounds>& solidBounds() const { return solidBounds_; }
  // and the drawn parts of planes.
  [[nodiscard]] const std::vector<PlaneDisc>& discs() const { return discs_; }

  void drawSolids(const gl::Program& sphere, const gl::Program& shape) const;
  void drawPlanes(const gl::Program& plane) const;

 private:
  double longestEdge_;
  ColliderSet colliders_;
  SphereMesh spheres_;
  ShapeMeshes shapes_;
  PlaneMesh planes_;
  std::vector<glm::vec4> places_;
  std::vector<Bounds> solidBounds_;
  std::vector<PlaneDisc> discs_;
};

}  // namespace clothsim
