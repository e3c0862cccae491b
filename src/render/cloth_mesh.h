// The cloth as triangles whose vertices are the particles themselves: positions stay in the solver's buffer,
// normals are computed beside them on the GPU.
#pragma once

#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "shared/render_layout.h"

namespace clothsim {

class ClothMesh {
 public:
  explicit ClothMesh(const Cloth& cloth);

  // Triangles with a cut side are drawn no more, and do not bend their neighbours' normals.
  void setCuts(const Cloth& cloth, const Cuts& cuts);
  [[nodiscard]] bool hasCuts() const { return cuts_.size() > 0; }

  // Smooth normals for the positions in `positions`, one vec4 a particle; by normals.comp, with CUTS when
  // there are any.
  void computeNormals(const gl::Program& normalsPass, GLuint positions);
  // The triangles of all grids, with the program and its state bound by the caller.
  void draw(GLuint positions);

  [[nodiscard]] const gl::Buffer<glm::vec4>& normals() const { return normals_; }

 private:
  struct GridBlock {
    gl::Buffer<shared::NormalsGrid> block;
    GLuint columns, rows;
  };

  std::vector<GridBlock> grids_;
  gl::Buffer<glm::vec4> normals_;
  gl::Buffer<std::uint32_t> indices_;
  gl::Buffer<std::uint32_t> cuts_;
  gl::Buffer<std::array<float, 2>> textureCoordinates_;
  gl::VertexArray vertices_;
};

}  // namespace clothsim
