// The edge of cloth that is drawn as thick as it is: along its borders and cuts half a tube joins the front,
// half a thickness above the particles, to the back.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "render/triangle_sides.h"
#include "shared/render_layout.h"

namespace clothsim {

// Of a grid without cuts.
[[nodiscard]] std::vector<BorderCorner> borderOfGrid(const Piece& points);

// How thick each piece is drawn [m]: as render.thickness says, else as its cloth is, but no more than half
// the distance of neighbours, as contact has it.
[[nodiscard]] std::vector<float> drawnThickness(const Scene& scene, const Cloth& cloth);

class ClothRim {
 public:
  struct Strip {
    shared::ClothPiece block;  // with its thickness
    std::vector<BorderCorner> corners;
  };
  // Of points with these texture coordinates, to which the corners refer.
  ClothRim(std::span<const Strip> strips, std::span<const std::array<float, 2>> textureCoordinates);

  // From the buffers of the points, a vec4 each: places, normals with hollows, tangents with strains.
  void compute(const gl::Program& program, GLuint positions, GLuint normals, GLuint tangents);
  // With the program and its state bound by the caller, who draws the cloth with the same. `only`: one piece.
  void draw(std::optional<std::size_t> only = {}) const;

 private:
  struct PieceBuffers {
    gl::Buffer<shared::ClothPiece> block;
    std::size_t firstIndex, indexCount;
  };
  std::vector<PieceBuffers> pieces_;
  gl::Buffer<glm::uvec4> corners_;
  gl::Buffer<glm::vec4> points_, normals_, tangents_;
  gl::Buffer<std::array<float, 2>> textureCoordinates_;
  gl::Buffer<std::uint32_t> indices_;
  gl::VertexArray vertices_{"cloth rim"};
};

}  // namespace clothsim
