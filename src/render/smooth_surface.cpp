#include "render/smooth_surface.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "render/pieces.h"
#include "render/refinement.h"

namespace clothsim {
namespace {

std::vector<std::uint32_t> wordsOf(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> words;
  words.reserve(3 * triangles.size());
  for (const auto& triangle : triangles) words.insert(words.end(), triangle.begin(), triangle.end());
  return words;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

bool isPatched(const Piece& piece, const Cuts& cuts) {
  if (piece.isMesh || cuts.empty()) return piece.isMesh;
  const auto first = cuts.begin() + piece.firstParticle;
  return std::any_of(first, first + piece.particleCount(), [](std::uint8_t bits) { return bits != 0; });
}

// Those of a piece, which lie together.
std::span<const std::array<std::uint32_t, 3>> ofPiece(const Triangles& triangles, const Piece& piece) {
  const auto isBefore = [](const auto& triangle, std::uint32_t particle) { return triangle[0] < particle; };
  const auto first = std::lower_bound(triangles.begin(), triangles.end(), piece.firstParticle, isBefore);
  const auto end =
      std::lower_bound(first, triangles.end(), piece.firstParticle + piece.particleCount(), isBefore);
  return {first, end};
}

// Before, here and after on the edges of a grid's cuts; without those on the grid's own border, and without
// particles at which edges meet.
std::vector<glm::uvec4> cornersOnCuts(const Piece& piece,
                                      std::span<const std::array<std::uint32_t, 3>> triangles) {
  const std::vector<BorderCorner> edge = borderOf(TriangleSides(triangles));
  std::vector<int> count(piece.particleCount());
  for (const BorderCorner& corner : edge) ++count[corner.here - piece.firstParticle];
  std::vector<glm::uvec4> corners;
  const auto columns = static_cast<std::uint32_t>(piece.columns),
             rows = static_cast<std::uint32_t>(piece.rows);
  for (const BorderCorner& corner : edge) {
    const std::uint32_t local = corner.here - piece.firstParticle, column = local % columns,
                        row = local / columns;
    const bool isInside = column > 0 && column + 1 < columns && row > 0 && row + 1 < rows;
    if (isInside && count[local] == 1) corners.emplace_back(corner.before, corner.here, corner.after, 0);
  }
  return corners;
}

}  // namespace

std::vector<std::uint32_t> smoothSteps(const Cloth& cloth, double pixelsAMetre,
                                       const RenderOptions& options) {
  // A chord of length l lies l^2 / (8 r) below an arc of radius r. Folds are 1.5 cells narrow, and the square
  // of a cell's diagonal is twice that of its side.
  constexpr double offACell = 2 / (8 * 1.5), offPixels = 0.3;
  constexpr std::uint64_t mostPoints = 1u << 21;
  std::uint64_t points = 0;
  std::vector<std::uint32_t> steps;
  for (const Piece& piece : cloth.pieces()) {
    const double cell = pixelsAMetre * std::max(piece.nominalLength[toLeft], piece.nominalLength[toUpper]);
    std::uint32_t n = 1;
    for (int level = 0; level < options.subdivisions && cell * offACell > offPixels * n * n; ++level) n *= 2;
    while (n > 1 && points + std::uint64_t{n} * n * piece.particleCount() > mostPoints) n /= 2;
    points += std::uint64_t{n} * n * piece.particleCount();
    steps.push_back(n);
  }
  return steps;
}

SmoothSurface::SmoothSurface(const Cloth& cloth, std::span<const std::uint32_t> steps, bool isLean,
                             std::span<const float> thickness, const Cuts& cuts, double layers)
    : steps_(steps.begin(), steps.end()), isLean_(isLean), vertices_("smooth surface") {
  Points all;
  const Triangles triangles =
      layers > 0 || cloth.hasMesh() || !cuts.empty() ? remainingTriangles(cloth, cuts) : Triangles{};
  if (layers > 0) layers_.emplace(cloth, triangles, layers);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Piece& piece = cloth.pieces()[i];
    shared::ClothPiece block = blockOf(piece);
    block.steps = steps_[i];
    block.firstPoint = all.count;
    block.firstControl = all.controls;
    if (layers > 0) {
      const auto own = ofPiece(triangles, piece);
      block.hasLayers = 1;
      block.firstTriangle = static_cast<std::uint32_t>(own.data() - triangles.data());
      block.triangles = static_cast<std::uint32_t>(own.size());
    }
    if (!thickness.empty()) block.halfThickness = thickness[i] / 2;
    pieces_.push_back(isPatched(piece, cuts)
                          ? makePatches(cloth, piece, ofPiece(triangles, piece), block, all)
                          : makeGrid(piece, block, all));
    pieces_.back().layerTriangles = block.triangles;
  }
  controls_ = gl::Buffer<glm::vec4>("smooth controls", all.controls);
  makePoints(all.count, all.textureCoordinates);
  if (!thickness.empty()) rim_.emplace(all.rim, all.textureCoordinates);
  if (!all.cutCorners.empty()) {
    cutCorners_ = gl::Buffer<glm::uvec4>("smooth cut corners", all.cutCorners);
    moved_ = gl::Buffer<glm::vec4>("smooth particles", cloth.particleCount());
  }
  if (!isLean) return;
  std::vector<std::uint32_t> places(all.count);
  std::iota(places.begin(), places.end(), 0u);  // where particles stay
  places_ = gl::Buffer<std::uint32_t>("smooth places", places);
  sides_ = gl::Buffer<std::uint32_t>("smooth sides", all.sides);
  centers_ = gl::Buffer<std::uint32_t>("smooth centers", all.centers);
}

SmoothSurface::PieceBuffers SmoothSurface::makeGrid(const Piece& piece, const shared::ClothPiece& block,
                                                    Points& all) const {
  const Refinement refinement = refineGrid(piece, block.steps, block.firstPoint);
  PieceBuffers made;
  made.block = gl::Buffer<shared::ClothPiece>("smooth piece", std::span(&block, 1));
  made.columns = block.columns;
  made.rows = block.rows;
  if (isLean_) {
    const std::array command{DrawCommand{}};
    const std::size_t cells = refinement.triangles.size() / 8;
    made.counts = gl::Buffer<std::uint32_t>("smooth counts", (cells + SMOOTH_GROUP - 1) / SMOOTH_GROUP);
    made.kept = gl::Buffer<std::uint32_t>("smooth triangles kept", 3 * refinement.triangles.size());
    made.command = gl::Buffer<DrawCommand>("smooth command", command);
  } else {
    made.triangles = gl::Buffer<std::uint32_t>("smooth triangles", wordsOf(refinement.triangles));
  }
  append(all.sides, refinement.sides);
  append(all.centers, refinement.centers);
  append(all.textureCoordinates, refinement.textureCoordinates);
  all.rim.push_back({block, borderOfGrid(refinement.grid)});
  all.count += refinement.pointCount;
  all.controls += 2 * (block.columns + 2) * (block.rows + 2);
  return made;
}

SmoothSurface::PieceBuffers SmoothSurface::makePatches(
    const Cloth& cloth, const Piece& piece, std::span<const std::array<std::uint32_t, 3>> triangles,
    const shared::ClothPiece& block, Points& all) const {
  const Patches patches = divideTriangles(triangles, block.steps, block.firstPoint, cloth.positions(),
                                          cloth.textureCoordinates(), cloth.textureSeams());
  PieceBuffers made;
  made.block = gl::Buffer<shared::ClothPiece>("smooth piece", std::span(&block, 1));
  made.patches = gl::Buffer<PatchPoint>("smooth patches", patches.points);
  made.triangles = gl::Buffer<std::uint32_t>("smooth triangles", wordsOf(patches.triangles));
  if (!piece.isMesh) append(all.cutCorners, cornersOnCuts(piece, triangles));
  append(all.textureCoordinates, patches.textureCoordinates);
  all.rim.push_back({block, patches.border});
  all.count += static_cast<std::uint32_t>(patches.points.size());
  return made;
}

void SmoothSurface::makePoints(std::uint32_t count,
                               std::span<const std::array<float, 2>> textureCoordinates) {
  points_ = gl::Buffer<glm::vec4>("smooth points", count);
  normals_ = gl::Buffer<glm::vec4>("smooth normals", count);
  tangents_ = gl::Buffer<glm::vec4>("smooth tangents", count);
  textureCoordinates_ = gl::Buffer<std::array<float, 2>>("smooth texture coordinates", textureCoordinates);
  vertices_.attach(points_.name(), {.location = POSITION_LOCATION});
  vertices_.attach(normals_.name(), {.location = NORMAL_LOCATION});
  vertices_.attach(tangents_.name(), {.location = TANGENT_LOCATION});
  vertices_.attach(textureCoordinates_.name(),
                   {.location = TEXTURE_COORDINATE_LOCATION, .components = 2, .stride = 8});
}

void SmoothSurface::compute(const SmoothPrograms& programs, GLuint positions, const ClothMesh& particles,
                            const LayerPrograms* layers) {
  if (moved_.size() > 0) evenOutCuts(programs, positions);
  const GLuint places = moved_.size() > 0 ? moved_.name() : positions;
  const auto bindParticles = [&] {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_POSITIONS_BINDING, places);
    particles.normals().bindStorage(NORMALS_OUT_BINDING);
    particles.tangents().bindStorage(TANGENTS_OUT_BINDING);
    controls_.bindStorage(SMOOTH_CONTROLS_BINDING);
  };
  bindParticles();
  dispatchGrids(programs.control, 2);
  if (layers_) {
    shareBetweenLayers(*layers, places);
    layers_->shares().bindStorage(SMOOTH_SHARES_BINDING);
    bindParticles();
  }
  points_.bindStorage(SMOOTH_POINTS_BINDING);
  normals_.bindStorage(SMOOTH_NORMALS_BINDING);
  tangents_.bindStorage(SMOOTH_TANGENTS_BINDING);
  dispatchGrids(isLean_ ? programs.leanPoints : programs.points);
  computePatches(programs);
  if (isLean_) chooseTriangles(programs);
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void SmoothSurface::dispatchGrids(const gl::Program& program, GLuint more) const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  program.bind();
  for (const PieceBuffers& piece : pieces_) {
    if (piece.isPatched()) continue;
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    gl::dispatch(piece.columns + more, piece.rows + more, NORMALS_GROUP_SIZE, NORMALS_GROUP_SIZE);
  }
}

void SmoothSurface::shareBetweenLayers(const LayerPrograms& programs, GLuint positions) {
  layers_->bindBulges();
  dispatchGrids(programs.bulges);
  for (const PieceBuffers& piece : pieces_) {
    if (!piece.isPatched()) continue;
    programs.patchBulges.bind();
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    gl::dispatch(piece.layerTriangles, SMOOTH_GROUP);
  }
  layers_->compute(programs, positions);
}

void SmoothSurface::computePatches(const SmoothPrograms& programs) {
  for (const PieceBuffers& piece : pieces_) {
    if (!piece.isPatched()) continue;
    programs.patches.bind();
    if (layers_) layers_->shares().bindStorage(PATCH_SHARES_BINDING);
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    piece.patches.bindStorage(PATCH_POINTS_BINDING);
    gl::dispatch(piece.patches.size(), SMOOTH_GROUP);
  }
}

void SmoothSurface::evenOutCuts(const SmoothPrograms& programs, GLuint positions) {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // the solver's last writes
  glCopyNamedBufferSubData(positions, moved_.name(), 0, 0, static_cast<GLsizeiptr>(moved_.bytes()));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_POSITIONS_BINDING, positions);
  cutCorners_.bindStorage(CUT_CORNERS_BINDING);
  moved_.bindStorage(SMOOTH_POINTS_BINDING);
  programs.cuts.bind();
  gl::dispatch(cutCorners_.size(), SMOOTH_GROUP);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void SmoothSurface::chooseTriangles(const SmoothPrograms& programs) {
  const auto choose = [](const gl::Program& program, const gl::Buffer<std::uint32_t>& middles,
                         std::size_t words) {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    program.bind();
    middles.bindStorage(SMOOTH_MIDDLES_BINDING);
    gl::dispatch(middles.size() / words, SMOOTH_GROUP);
  };
  places_.bindStorage(SMOOTH_PLACES_BINDING);
  choose(programs.chooseSides, sides_, 3);
  choose(programs.chooseCenters, centers_, 7);
  for (const gl::Program* program : {&programs.count, &programs.triangles}) {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    program->bind();
    for (const PieceBuffers& piece : pieces_) {
      piece.block.bindUniform(CLOTH_GRID_BINDING);
      piece.counts.bindStorage(SMOOTH_COUNTS_BINDING);
      piece.kept.bindStorage(SMOOTH_KEPT_BINDING);
      piece.command.bindStorage(SMOOTH_COMMAND_BINDING);
      gl::dispatch(piece.counts.size(), 1);
    }
  }
}

void SmoothSurface::computeRim(const gl::Program& program) {
  if (isLean_) places_.bindStorage(RIM_PLACES_BINDING);
  if (rim_) rim_->compute(program, points_.name(), normals_.name(), tangents_.name());
}

void SmoothSurface::drawRim(std::optional<std::size_t> only) const {
  if (rim_) rim_->draw(only);
}

void SmoothSurface::draw(std::optional<std::size_t> only) {
  for (const PieceBuffers& piece : piecesOf(std::span(pieces_), only)) {
    vertices_.attachIndices(isLean_ ? piece.kept.name() : piece.triangles.name());
    vertices_.bind();
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    if (isLean_) {
      piece.command.bindDraws();
      glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr);
    } else {
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(piece.triangles.size()), GL_UNSIGNED_INT, nullptr);
    }
  }
}

std::vector<std::array<std::uint32_t, 3>> SmoothSurface::triangles() const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<std::array<std::uint32_t, 3>> drawn;
  for (const PieceBuffers& piece : pieces_) {
    const std::vector<std::uint32_t> words =
        isLean_ ? piece.kept.download(0, piece.command.download().front().count) : piece.triangles.download();
    for (std::size_t i = 0; i + 2 < words.size(); i += 3)
      drawn.push_back({words[i], words[i + 1], words[i + 2]});
  }
  return drawn;
}

}  // namespace clothsim
