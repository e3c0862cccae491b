#include "render/cloth_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "render/mesh_neighbours.h"

namespace clothsim {
namespace {

constexpr double fold = 0.03;  // [m], about the width of a fold, whose hollow differs from its ridge

shared::ClothGrid blockOfMesh(const Grid& mesh) {
  shared::ClothGrid block{};
  block.firstParticle = mesh.firstParticle;
  block.columns = mesh.particleCount();
  block.rows = 1;
  block.width = static_cast<float>(mesh.textureSize[0]);
  block.height = static_cast<float>(mesh.textureSize[1]);
  block.longer = std::max({block.width, block.height, 1e-9f});
  block.front = 1;
  return block;
}

shared::ClothGrid blockOf(const Grid& grid) {
  if (grid.isMesh) return blockOfMesh(grid);
  const double right = grid.nominalLength[toLeft], down = grid.nominalLength[toUpper];
  const double spacing = std::max(right, down);
  const long ring = spacing > 0 ? std::clamp(std::lround(fold / spacing), 1L, 64L) : 1;
  shared::ClothGrid block{};
  block.firstParticle = grid.firstParticle;
  block.columns = static_cast<GLuint>(grid.columns);
  block.rows = static_cast<GLuint>(grid.rows);
  block.ring = static_cast<GLuint>(ring);
  block.width = static_cast<float>(right * (grid.columns - 1));
  block.height = static_cast<float>(down * (grid.rows - 1));
  block.longer = std::max({block.width, block.height, 1e-9f});
  block.reach = static_cast<float>(spacing * static_cast<double>(ring));
  block.front = grid.rowsGoUp ? -1.0f : 1.0f;
  return block;
}

}  // namespace

ClothMesh::ClothMesh(const Cloth& cloth)
    : normals_("cloth normals", cloth.particleCount()),
      tangents_("cloth tangents", cloth.particleCount()),
      textureCoordinates_("cloth texture coordinates", cloth.textureCoordinates()),
      vertices_("cloth") {
  for (const Grid& grid : cloth.grids()) {
    const std::array block{blockOf(grid)};
    grids_.push_back({.block = gl::Buffer<shared::ClothGrid>("cloth grid", block),
                      .columns = block[0].columns,
                      .rows = block[0].rows,
                      .firstParticle = grid.firstParticle,
                      .particles = grid.particleCount(),
                      .neighbours = {}});
    if (grid.isMesh)
      grids_.back().neighbours =
          gl::Buffer<std::uint32_t>("mesh neighbours", meshNeighbours(cloth, grid, fold));
  }
  vertices_.attach(normals_.name(), {.location = NORMAL_LOCATION});
  vertices_.attach(tangents_.name(), {.location = TANGENT_LOCATION});
  vertices_.attach(textureCoordinates_.name(),
                   {.location = TEXTURE_COORDINATE_LOCATION, .components = 2, .stride = 8});
  setTriangles(cloth.triangles());
}

// Grid by grid, as remainingTriangles() has them.
void ClothMesh::setTriangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * triangles.size());
  for (const auto& triangle : triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  indices_ = gl::Buffer<std::uint32_t>("cloth indices", indices);
  vertices_.attachIndices(indices_.name());
  auto triangle = triangles.begin();
  for (GridPart& grid : grids_) {
    const auto end = std::find_if(triangle, triangles.end(), [&](const auto& corners) {
      return corners[0] - grid.firstParticle >= grid.particles;
    });
    grid.firstIndex = 3 * static_cast<std::size_t>(triangle - triangles.begin());
    grid.indexCount = 3 * static_cast<std::size_t>(end - triangle);
    triangle = end;
  }
}

void ClothMesh::setCuts(const Cloth& cloth, const Cuts& cuts) {
  if (cuts.empty() && !hasCuts()) return;
  setTriangles(remainingTriangles(cloth, cuts));
  const std::vector<std::uint32_t> words(cuts.begin(), cuts.end());
  cuts_ = words.empty() ? gl::Buffer<std::uint32_t>() : gl::Buffer<std::uint32_t>("cuts", words);
}

void ClothMesh::keepRestPositions(const Cloth& cloth) {
  if (restPositions_.size() > 0) return;
  std::vector<glm::vec4> rest;
  rest.reserve(cloth.particleCount());
  for (const Vec3d& p : cloth.positions())
    rest.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0.0f);
  restPositions_ = gl::Buffer<glm::vec4>("cloth at rest", rest);
}

void ClothMesh::computeNormals(const NormalsPrograms& programs, GLuint positions) {
  if (hasCuts()) cuts_.bindStorage(CUTS_BINDING);
  if (restPositions_.size() > 0) restPositions_.bindStorage(REST_POSITIONS_BINDING);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // the solver's last writes
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_POSITIONS_BINDING, positions);
  normals_.bindStorage(NORMALS_OUT_BINDING);
  tangents_.bindStorage(TANGENTS_OUT_BINDING);
  for (const GridPart& grid : grids_) {
    grid.block.bindUniform(CLOTH_GRID_BINDING);
    if (grid.isMesh()) {
      grid.neighbours.bindStorage(MESH_CORNERS_BINDING);
      textureCoordinates_.bindStorage(MESH_COORDINATES_BINDING);
      programs.mesh->bind();
      gl::dispatch(grid.columns, 1, MESH_NORMALS_GROUP, 1);
      continue;
    }
    programs.grid.bind();
    gl::dispatch(grid.columns, grid.rows, NORMALS_GROUP_SIZE, NORMALS_GROUP_SIZE);
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);  // normals, and the solver's positions, as vertices
}

void ClothMesh::draw(GLuint positions, bool meshesAsLines) {
  vertices_.attach(positions, {.location = POSITION_LOCATION});
  vertices_.bind();
  for (const GridPart& grid : grids_) {
    grid.block.bindUniform(CLOTH_GRID_BINDING);
    const bool asLines = meshesAsLines && grid.isMesh();
    if (asLines) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(grid.indexCount), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(grid.firstIndex * sizeof(std::uint32_t)));
    if (asLines) glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  }
}

}  // namespace clothsim
