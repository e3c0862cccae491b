// What lies under a pixel: one draw of identities through a 1 x 1 window, and one pixel read back.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "gl/framebuffer.h"

namespace clothsim {

struct Pick {
  enum class Kind { nothing, cloth, collider } kind = Kind::nothing;
  std::size_t piece = 0;       // cloth: number of the grid,
  LatticePoint lattice;        // where on it, in units of its cells (nothing of a mesh),
  std::uint32_t particle = 0;  // and the nearest corner of the triangle there (of a mesh any corner)
  std::size_t collider = 0;    // collider: its index in scene.colliders. Planes count, too, from their front
  glm::vec3 point{0};          // in the world [m]
};

class PickTarget {
 public:
  // The transformation after which the pixel at x, y (from the top left, in a picture of width x height
  // pixels) fills all of clip space.
  [[nodiscard]] static glm::mat4 clipFromPicture(int width, int height, double x, double y);

  void begin() const;  // clears it; leaves with the state to draw identities with
  void end() const;

  // Reads the pixel. `clipFromWorld` is the picture's, `ndc` the pixel's place in it (-1 to 1).
  [[nodiscard]] Pick read(std::span<const Piece> pieces, const glm::mat4& clipFromWorld, glm::vec2 ndc,
                          glm::vec3 eye) const;

 private:
  gl::Framebuffer pixel_{"pick",
                         {.width = 1, .height = 1, .color = GL_RGBA32UI, .depth = GL_DEPTH_COMPONENT32F}};
};

}  // namespace clothsim
