#include "render/cloth_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace clothsim {
namespace {

std::vector<std::uint32_t> indicesOf(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * triangles.size());
  for (const auto& triangle : triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  return indices;
}

// Points between a particle and the ring around it whose height tells a fold's hollow from its ridge.
GLuint ringOf(const Grid& grid) {
  constexpr double distance = 0.03;  // [m], about the width of a fold
  const double spacing = std::max(grid.nominalLength[toLeft], grid.nominalLength[toUpper]);
  return spacing > 0 ? static_cast<GLuint>(std::clamp(std::lround(distance / spacing), 1L, 64L)) : 1;
}

}  // namespace

ClothMesh::ClothMesh(const Cloth& cloth)
    : normals_("cloth normals", cloth.particleCount()),
      indices_("cloth indices", indicesOf(cloth.triangles())),
      textureCoordinates_("cloth texture coordinates", cloth.textureCoordinates()),
      vertices_("cloth") {
  for (const Grid& grid : cloth.grids()) {
    const auto columns = static_cast<GLuint>(grid.columns), rows = static_cast<GLuint>(grid.rows);
    const std::array block{shared::NormalsGrid{grid.firstParticle, columns, rows, ringOf(grid)}};
    grids_.push_back({gl::Buffer<shared::NormalsGrid>("normals grid", block), columns, rows});
  }
  vertices_.attach(normals_.name(), {.location = NORMAL_LOCATION});
  vertices_.attach(textureCoordinates_.name(),
                   {.location = TEXTURE_COORDINATE_LOCATION, .components = 2, .stride = 8});
  vertices_.attachIndices(indices_.name());
}

void ClothMesh::setCuts(const Cloth& cloth, const Cuts& cuts) {
  if (cuts.empty() && !hasCuts()) return;
  indices_ = gl::Buffer<std::uint32_t>("cloth indices", indicesOf(remainingTriangles(cloth, cuts)));
  vertices_.attachIndices(indices_.name());
  const std::vector<std::uint32_t> words(cuts.begin(), cuts.end());
  cuts_ = words.empty() ? gl::Buffer<std::uint32_t>() : gl::Buffer<std::uint32_t>("cuts", words);
}

void ClothMesh::computeNormals(const gl::Program& normalsPass, GLuint positions) {
  normalsPass.bind();
  if (hasCuts()) cuts_.bindStorage(CUTS_BINDING);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // the solver's last writes
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_POSITIONS_BINDING, positions);
  normals_.bindStorage(NORMALS_OUT_BINDING);
  for (const GridBlock& grid : grids_) {
    grid.block.bindUniform(NORMALS_GRID_BINDING);
    gl::dispatch(grid.columns, grid.rows, NORMALS_GROUP_SIZE, NORMALS_GROUP_SIZE);
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);  // normals, and the solver's positions, as vertices
}

void ClothMesh::draw(GLuint positions) {
  vertices_.attach(positions, {.location = POSITION_LOCATION});
  vertices_.bind();
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace clothsim
