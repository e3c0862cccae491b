// All colliders of a scene as drawn, and the floor that a scene without one gets.
#pragma once

#include "gl/program.h"
#include "render/collider_meshes.h"
#include "render/shape_meshes.h"
#include "render/stage.h"
#include "scene/scene.h"

namespace clothsim {

// Where a solid is seen.
struct SolidPlace {
  glm::vec3 at;
  glm::mat3 rotation;    // none of a sphere, which looks the same however it is turned
  Bounds box;            // around it
  ShapeMoment moment{};  // of one that deforms
  friend bool operator==(const SolidPlace& a, const SolidPlace& b) {
    return a.at == b.at && a.rotation == b.rotation && a.moment == b.moment;
  }
};

// Whether the stage's ground is drawn, and its place: xyz: its middle, w: how far it reaches [m].
[[nodiscard]] bool hasGround(const Scene& scene);
[[nodiscard]] glm::vec4 groundPlace(const Scene& scene, const Stage& stage);

class Colliders {
 public:
  // @param longestEdge  the longest side of the cloth's triangles [m], for which solids are drawn smaller
  Colliders(int sphereSegmentsAround, int sphereSegmentsDown, double longestEdge)
      : longestEdge_(longestEdge), spheres_(sphereSegmentsAround, sphereSegmentsDown) {}

  void build(const Scene& scene);
  // Where those of the scene that was built are at `time` [s].
  void place(const Scene& scene, const Stage& stage, double time);

  // As place() has put them: the solids, in the order of the scene, and the drawn parts of planes.
  [[nodiscard]] const std::vector<SolidPlace>& solids() const { return solids_; }
  [[nodiscard]] const std::vector<PlaneDisc>& discs() const { return discs_; }

  void drawSolids(const gl::Program& sphere, const gl::Program& shape) const;
  void drawPlanes(const gl::Program& plane) const;
  void drawPlane(const gl::Program& plane, std::size_t number) const;  // of discs()

 private:
  double longestEdge_;
  ColliderSet colliders_;
  SphereMesh spheres_;
  ShapeMeshes shapes_;
  PlaneMesh planes_;
  std::vector<SolidPlace> solids_;
  std::vector<PlaneDisc> discs_;
};

}  // namespace clothsim
