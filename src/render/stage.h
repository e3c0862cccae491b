// Where the action is expected: what the default camera frames, the shadow map covers and the floor lies
// under. A guess from the scene alone, so that drawing never has to read particles back.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "cloth/cloth.h"
#include "scene/scene.h"

namespace clothsim {

struct Bounds {
  glm::vec3 low{1e30f}, high{-1e30f};  // [m]; empty until something is added
  void add(glm::vec3 point);
  void add(const Bounds& other);
  [[nodiscard]] glm::vec3 center() const { return 0.5f * (low + high); }
  [[nodiscard]] glm::vec3 size() const { return high - low; }
};

// What is needed of a cloth to guess where it may go: some of its points and pins, grid by grid.
struct ClothOutline {
  struct Pin {
    glm::vec3 place;      // at the start [m]
    std::uint32_t point;  // its number on the grid
  };
  struct GridPoints {
    std::vector<glm::vec3> points, coarse;  // at the start [m]: its border and a raster; a few of them
    std::vector<Pin> pins;
  };
  std::vector<GridPoints> pieces;
  glm::vec3 front{0, 0, 1};  // horizontal direction from which the cloth shows its front
};
[[nodiscard]] ClothOutline outlineOf(const Cloth& cloth);

struct Stage {
  // What a picture should show: cloth after its fall, and the solids; and what is there for a moment or less
  // important, cloth before its fall and the shadow on the floor.
  std::vector<glm::vec3> staying, passing;
  Bounds view;            // around the cloth before and after its fall, and the solids
  Bounds reach;           // where cloth and solids may throw shadows: the swing, too
  float floorHeight = 0;  // y of the floor drawn when the scene has no horizontal plane [m]
};

[[nodiscard]] Stage makeStage(const ClothOutline& cloth, const Scene& scene);

[[nodiscard]] inline glm::vec3 toGlm(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
[[nodiscard]] inline Vec3d toVec3d(glm::vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace clothsim
