// The parts of a mesh that are stiffer or softer than its material says (cloth.stiffness_map).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

struct MeshShape;

// A part with the factor f makes what lies between some points 1 + w (f - 1) times as stiff, where w is the
// least weight of these points in the part (cloth/pins.h). Factors of parts that overlap multiply.
class StiffnessMap {
 public:
  // Of the mesh of a cloth. @throws SceneError when a part names what the mesh does not have, or has a factor
  // that nothing feels: no triangle, or of springs no edge, to stretch, or no inner edge to bend across
  StiffnessMap(const ClothSettings& cloth, const MeshShape& shape);

  // Between the ends of an edge, or the corners of a triangle; > 0.
  [[nodiscard]] double stretchFactor(std::initializer_list<std::uint32_t> points) const;
  // Across an edge with these ends; 0 or more.
  [[nodiscard]] double bendFactor(std::initializer_list<std::uint32_t> points) const;

 private:
  struct Part {
    std::vector<double> weights;  // by point, 0 to 1
    double stretch = 1, bend = 1;
  };
  std::vector<Part> parts_;
};

}  // namespace clothsim
