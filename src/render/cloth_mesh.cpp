#include "render/cloth_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "render/mesh_neighbours.h"
#include "render/pieces.h"

namespace clothsim {
namespace {

constexpr double fold = 0.03;  // [m], about the width of a fold, whose hollow differs from its ridge

shared::ClothPiece blockOfMesh(const Piece& mesh) {
  shared::ClothPiece block{};
  block.firstParticle = mesh.firstParticle;
  block.columns = mesh.particleCount();
  block.rows = 1;
  block.width = static_cast<float>(mesh.textureSize[0]);
  block.height = static_cast<float>(mesh.textureSize[1]);
  block.longer = std::max({block.width, block.height, 1e-9f});
  block.front = 1;
  return block;
}

void drawIndices(std::size_t first, std::size_t count) {
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

// 0, 2, 4, ... and the last one.
std::vector<GLuint> everySecond(GLuint count) {
  std::vector<GLuint> chosen;
  for (GLuint i = 0; i + 1 < count; i += 2) chosen.push_back(i);
  chosen.push_back(count - 1);
  return chosen;
}

}  // namespace

shared::ClothPiece blockOf(const Piece& piece) {
  if (piece.isMesh) return blockOfMesh(piece);
  const double right = piece.nominalLength[toLeft], down = piece.nominalLength[toUpper];
  const double spacing = std::max(right, down);
  const long ring = spacing > 0 ? std::clamp(std::lround(fold / spacing), 1L, 64L) : 1;
  shared::ClothPiece block{};
  block.firstParticle = piece.firstParticle;
  block.columns = static_cast<GLuint>(piece.columns);
  block.rows = static_cast<GLuint>(piece.rows);
  block.ring = static_cast<GLuint>(ring);
  block.width = static_cast<float>(right * (piece.columns - 1));
  block.height = static_cast<float>(down * (piece.rows - 1));
  block.longer = std::max({block.width, block.height, 1e-9f});
  block.reach = static_cast<float>(spacing * static_cast<double>(ring));
  block.front = piece.rowsGoUp ? -1.0f : 1.0f;
  return block;
}

// Divided as the cells of the whole grid.
std::vector<std::uint32_t> coarseTriangles(GLuint columns, GLuint rows, GLuint first) {
  const std::vector<GLuint> across = everySecond(columns), down = everySecond(rows);
  std::vector<std::uint32_t> indices;
  for (std::size_t row = 0; row + 1 < down.size(); ++row)
    for (std::size_t column = 0; column + 1 < across.size(); ++column) {
      const auto at = [&](std::size_t c, std::size_t r) { return first + down[r] * columns + across[c]; };
      const GLuint a = at(column, row), b = at(column + 1, row), c = at(column, row + 1),
                   d = at(column + 1, row + 1);
      indices.insert(indices.end(), {a, c, b, b, c, d});
    }
  return indices;
}

ClothMesh::ClothMesh(const Cloth& cloth)
    : normals_("cloth normals", cloth.particleCount()),
      tangents_("cloth tangents", cloth.particleCount()),
      textureCoordinates_("cloth texture coordinates", textureCoordinatesOf(cloth)),
      positionsTexture_("cloth positions", normals_.name(), GL_RGBA32F),
      vertices_("cloth") {
  for (const Piece& piece : cloth.pieces()) {
    const std::array block{blockOf(piece)};
    pieces_.push_back({.block = gl::Buffer<shared::ClothPiece>("cloth grid", block),
                       .columns = block[0].columns,
                       .rows = block[0].rows,
                       .firstParticle = piece.firstParticle,
                       .particles = piece.particleCount(),
                       .neighbours = {},
                       .values = block[0]});
  }
  setNeighbours(cloth, cloth.lists());
  vertices_.attach(normals_.name(), {.location = NORMAL_LOCATION});
  vertices_.attach(tangents_.name(), {.location = TANGENT_LOCATION});
  vertices_.attach(textureCoordinates_.name(),
                   {.location = TEXTURE_COORDINATE_LOCATION, .components = 2, .stride = 8});
  setTriangles(cloth.triangles());
}

void ClothMesh::setNeighbours(const Cloth& cloth, const SpringLists& lists) {
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (const Piece& piece = cloth.pieces()[i]; piece.isMesh) {
      PieceBuffers& buffers = pieces_[i];
      buffers.neighbours =
          gl::Buffer<std::uint32_t>("mesh neighbours", meshNeighbours(cloth, lists, piece, fold));
      buffers.neighboursTexture = gl::BufferTexture("mesh neighbours", buffers.neighbours.name(), GL_R32UI);
    }
}

// Grid by grid, as remainingTriangles() has them.
void ClothMesh::setTriangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  rim_.reset();
  followsFolds_ = false;
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * triangles.size());
  for (const auto& triangle : triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  auto triangle = triangles.begin();
  for (PieceBuffers& piece : pieces_) {
    const auto end = std::find_if(triangle, triangles.end(), [&](const auto& corners) {
      return corners[0] - piece.firstParticle >= piece.particles;
    });
    piece.firstIndex = 3 * static_cast<std::size_t>(triangle - triangles.begin());
    piece.indexCount = 3 * static_cast<std::size_t>(end - triangle);
    triangle = end;
    piece.firstCoarseIndex = indices.size();
    const std::size_t whole = std::size_t{6} * (piece.columns - 1) * (piece.rows - 1);
    if (!piece.isMesh() && piece.indexCount == whole) {
      const std::vector<std::uint32_t> coarse =
          coarseTriangles(piece.columns, piece.rows, piece.firstParticle);
      indices.insert(indices.end(), coarse.begin(), coarse.end());
    }
    piece.coarseIndexCount = indices.size() - piece.firstCoarseIndex;
  }
  indices_ = gl::Buffer<std::uint32_t>("cloth indices", indices);
  vertices_.attachIndices(indices_.name());
}

void ClothMesh::setCuts(const Cloth& cloth, const Cuts& cuts) {
  if (cuts.empty() && !hasCuts()) return;
  setTriangles(remainingTriangles(cloth, cuts));
  if (cloth.hasMesh()) setNeighbours(cloth, remainingLists(cloth, cuts));
  const std::vector<std::uint32_t> words(cuts.begin(), cuts.end());
  cuts_ = words.empty() ? gl::Buffer<std::uint32_t>() : gl::Buffer<std::uint32_t>("cuts", words);
}

void ClothMesh::setThickness(std::span<const float> thickness) {
  rim_.reset();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    pieces_[i].values.halfThickness = thickness[i] / 2;
    pieces_[i].block.upload(std::span(&pieces_[i].values, 1));
  }
}

void ClothMesh::makeRim() {
  const std::vector<std::uint32_t> words = indices_.download();
  std::vector<ClothRim::Strip> strips;
  for (const PieceBuffers& piece : pieces_) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t at = piece.firstIndex; at < piece.firstIndex + piece.indexCount; at += 3)
      triangles.push_back({words[at], words[at + 1], words[at + 2]});
    strips.push_back({piece.values, borderOf(TriangleSides(triangles))});
  }
  rim_.emplace(strips, textureCoordinates_.download());
}

void ClothMesh::computeRim(const gl::Program& program, GLuint positions) {
  if (!rim_) makeRim();
  rim_->compute(program, positions, normals_.name(), tangents_.name());
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
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);  // the solver's last writes
  positionsTexture_.attach(positions, GL_RGBA32F);  // whose name may be that of one that is gone
  positionsTexture_.bind(NORMALS_POSITIONS_UNIT);
  normals_.bindStorage(NORMALS_OUT_BINDING);
  tangents_.bindStorage(TANGENTS_OUT_BINDING);
  for (const PieceBuffers& piece : pieces_) {
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    if (piece.isMesh()) {
      piece.neighboursTexture.bind(MESH_CORNERS_UNIT);
      textureCoordinates_.bindStorage(MESH_COORDINATES_BINDING);
      programs.mesh->bind();
      gl::dispatch(piece.columns, 1, MESH_NORMALS_GROUP, 1);
      continue;
    }
    programs.piece.bind();
    gl::dispatch(piece.columns, piece.rows, NORMALS_GROUP_SIZE, NORMALS_GROUP_SIZE);
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);  // normals, and the solver's positions, as vertices
}

void ClothMesh::followFolds(const gl::Program* diagonals) {
  followsFolds_ = diagonals != nullptr && !hasCuts();
  if (!followsFolds_) return;
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  normals_.bindStorage(NORMALS_OUT_BINDING);
  diagonals->bind();
  for (PieceBuffers& piece : pieces_) {
    if (!piece.hasCells()) continue;
    if (piece.followingIndices.size() == 0)
      piece.followingIndices = gl::Buffer<std::uint32_t>("cloth indices along folds", piece.indexCount);
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    piece.followingIndices.bindStorage(DIAGONALS_BINDING);
    gl::dispatch(piece.columns - 1, piece.rows - 1, NORMALS_GROUP_SIZE, NORMALS_GROUP_SIZE);
  }
  glMemoryBarrier(GL_ELEMENT_ARRAY_BARRIER_BIT);
}

void ClothMesh::drawRim(std::optional<std::size_t> only) const {
  if (rim_) rim_->draw(only);
}

void ClothMesh::attach(GLuint positions) {
  vertices_.attach(positions, {.location = POSITION_LOCATION});
  vertices_.bind();
}

void ClothMesh::drawCoarsely(GLuint positions) {
  attach(positions);
  for (const PieceBuffers& piece : pieces_) {
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    const bool isCoarse = piece.coarseIndexCount > 0;
    drawIndices(isCoarse ? piece.firstCoarseIndex : piece.firstIndex,
                isCoarse ? piece.coarseIndexCount : piece.indexCount);
  }
}

void ClothMesh::draw(GLuint positions, bool meshesAsLines, std::optional<std::size_t> only) {
  attach(positions);
  for (const PieceBuffers& piece : piecesOf(std::span(pieces_), only)) {
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    const bool asLines = meshesAsLines && piece.isMesh();
    if (asLines) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    const bool follows = followsFolds_ && piece.hasCells();
    if (follows) vertices_.attachIndices(piece.followingIndices.name());
    drawIndices(follows ? 0 : piece.firstIndex, piece.indexCount);
    if (follows) vertices_.attachIndices(indices_.name());
    if (asLines) glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  }
}

}  // namespace clothsim
