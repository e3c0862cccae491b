// The key light's shadow map: depth of the nearest surface seen along the light's rays, over a fixed part of
// the world.
#pragma once

#include <glm/glm.hpp>

#include "gl/framebuffer.h"
#include "gl/vertex_array.h"
#include "render/flat_bounds.h"
#include "render/programs.h"
#include "render/stage.h"

namespace clothsim {

class ShadowMap {
 public:
  explicit ShadowMap(int size);  // [texels] along each side

  // Fits the map around `reach` as seen from the light.
  void cover(const Bounds& reach, glm::vec3 toLight);

  // Clears it and makes it the target; leaves with the state that casters are drawn with. With `part`, 0 to 1
  // in each coordinate, only that of it.
  void begin(const FlatBounds* part = nullptr) const;
  void end() const;
  void blurForFloors(const RenderPrograms& programs, const FlatBounds* part = nullptr) const;  // after end()
  void bindTextures() const;
  void bindDepth(GLuint unit) const;  // the map alone

  [[nodiscard]] const glm::mat4& shadowFromWorld() const { return shadowFromWorld_; }
  [[nodiscard]] float texelLength() const { return texelLength_; }  // [m]

 private:
  gl::Framebuffer framebuffer_, halfBlurred_, floorShadow_;
  gl::VertexArray noVertices_{"no vertices"};
  glm::mat4 shadowFromWorld_{1};
  float texelLength_ = 0;
};

}  // namespace clothsim
