// The cloth as triangles whose vertices are the particles themselves: positions stay in the solver's buffer;
// normals and tangents are computed beside them on the GPU.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "render/cloth_rim.h"
#include "shared/render_layout.h"

namespace clothsim {

// normals.comp, with CUTS when there are any; and mesh_normals.comp, null for a cloth without meshes.
struct NormalsPrograms {
  const gl::Program& piece;
  const gl::Program* mesh = nullptr;
};

// What a program knows of a piece that it draws; without a smooth surface.
[[nodiscard]] shared::ClothPiece blockOf(const Piece& piece);

// The triangles of every second row and column of a grid, with the last ones, as indices from `first` on.
[[nodiscard]] std::vector<std::uint32_t> coarseTriangles(GLuint columns, GLuint rows, GLuint first);

class ClothMesh {
 public:
  explicit ClothMesh(const Cloth& cloth);

  // Triangles with a cut side are drawn no more, and do not bend their neighbours' normals.
  void setCuts(const Cloth& cloth, const Cuts& cuts);
  [[nodiscard]] bool hasCuts() const { return cuts_.size() > 0; }
  // How thick each piece is drawn, by programs with THICK [m]. Without it nothing has an edge.
  void setThickness(std::span<const float> thickness);
  // For a normals pass with STRAIN, which compares with the cloth at rest.
  void keepRestPositions(const Cloth& cloth);

  // Smooth normals, tangents and strains for the positions in `positions`, one vec4 a particle.
  void computeNormals(const NormalsPrograms& programs, GLuint positions);
  // With diagonals.comp draw() divides the cells of grids along folds, as the normals now show them; with
  // null, or where anything is cut, as the springs do.
  void followFolds(const gl::Program* diagonals);
  // The triangles of all pieces, with the program and its state bound by the caller.
  // `only`: one piece.
  void draw(GLuint positions, bool meshesAsLines = false, std::optional<std::size_t> only = {});
  // The same, of every second row and column where a piece is a whole grid: a quarter of the triangles.
  void drawCoarsely(GLuint positions);
  // The edge of cloth that is thick, of which draw() is the sides: after computeNormals(). Made when it is
  // first asked for.
  void computeRim(const gl::Program& program, GLuint positions);
  void drawRim(std::optional<std::size_t> only = {}) const;

  // A vec4 a particle: unit normal; how far the cloth around rises above the tangent plane.
  [[nodiscard]] const gl::Buffer<glm::vec4>& normals() const { return normals_; }
  // A vec4 a particle: unit direction of u; largest l/L - 1 of the cell sides and diagonals around it (0
  // without STRAIN).
  [[nodiscard]] const gl::Buffer<glm::vec4>& tangents() const { return tangents_; }

 private:
  struct PieceBuffers {
    gl::Buffer<shared::ClothPiece> block;
    GLuint columns, rows, firstParticle, particles;
    gl::Buffer<std::uint32_t> neighbours;  // of a mesh: meshNeighbours()
    gl::BufferTexture neighboursTexture{};
    std::size_t firstIndex = 0, indexCount = 0;
    std::size_t firstCoarseIndex = 0, coarseIndexCount = 0;  // 0: it has none
    gl::Buffer<std::uint32_t> followingIndices{};  // cells divided along folds; empty until asked for
    shared::ClothPiece values{};
    [[nodiscard]] bool isMesh() const { return neighbours.size() > 0; }
    [[nodiscard]] bool hasCells() const { return !isMesh() && columns > 1 && rows > 1; }
  };
  void attach(GLuint positions);
  void makeRim();
  void setNeighbours(const Cloth& cloth, const SpringLists& lists);
  void setTriangles(const std::vector<std::array<std::uint32_t, 3>>& triangles);

  std::vector<PieceBuffers> pieces_;
  gl::Buffer<glm::vec4> normals_, tangents_, restPositions_;
  gl::Buffer<std::uint32_t> indices_;
  gl::Buffer<std::uint32_t> cuts_;
  gl::Buffer<std::array<float, 2>> textureCoordinates_;
  gl::BufferTexture positionsTexture_;  // of the buffer that is measured
  bool followsFolds_ = false;
  std::optional<ClothRim> rim_;
  gl::VertexArray vertices_;
};

}  // namespace clothsim
