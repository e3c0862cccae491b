#include "render/smooth_surface.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

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
                             std::span<const float> thickness)
    : steps_(steps.begin(), steps.end()), isLean_(isLean), vertices_("smooth surface") {
  std::uint32_t pointCount = 0, controlCount = 0;
  std::vector<std::uint32_t> sides, centers;
  std::vector<std::array<float, 2>> coordinates;
  std::vector<ClothRim::Strip> rim;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Piece& piece = cloth.pieces()[i];
    const Refinement refinement = refineGrid(piece, steps_[i], pointCount);
    std::array block{blockOf(piece)};
    block[0].steps = steps_[i];
    block[0].firstPoint = pointCount;
    block[0].firstControl = controlCount;
    if (!thickness.empty()) {
      block[0].halfThickness = thickness[i] / 2;
      rim.push_back({block[0], borderOfGrid(refinement.grid)});
    }
    PieceBuffers& made = pieces_.emplace_back();
    made.block = gl::Buffer<shared::ClothPiece>("smooth piece", block);
    made.columns = block[0].columns;
    made.rows = block[0].rows;
    if (isLean) {
      const std::array command{DrawCommand{}};
      const std::size_t cells = refinement.triangles.size() / 8;
      made.counts = gl::Buffer<std::uint32_t>("smooth counts", (cells + SMOOTH_GROUP - 1) / SMOOTH_GROUP);
      made.kept = gl::Buffer<std::uint32_t>("smooth triangles kept", 3 * refinement.triangles.size());
      made.command = gl::Buffer<DrawCommand>("smooth command", command);
    } else {
      made.triangles = gl::Buffer<std::uint32_t>("smooth triangles", wordsOf(refinement.triangles));
    }
    append(sides, refinement.sides);
    append(centers, refinement.centers);
    append(coordinates, refinement.textureCoordinates);
    pointCount += refinement.pointCount;
    controlCount += 2 * (block[0].columns + 2) * (block[0].rows + 2);
  }
  controls_ = gl::Buffer<glm::vec4>("smooth controls", controlCount);
  makePoints(pointCount, coordinates);
  if (!rim.empty()) rim_.emplace(rim, coordinates);
  if (!isLean) return;
  std::vector<std::uint32_t> places(pointCount);
  std::iota(places.begin(), places.end(), 0u);  // where particles stay
  places_ = gl::Buffer<std::uint32_t>("smooth places", places);
  sides_ = gl::Buffer<std::uint32_t>("smooth sides", sides);
  centers_ = gl::Buffer<std::uint32_t>("smooth centers", centers);
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

void SmoothSurface::compute(const SmoothPrograms& programs, GLuint positions, const ClothMesh& particles) {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_POSITIONS_BINDING, positions);
  particles.normals().bindStorage(NORMALS_OUT_BINDING);
  particles.tangents().bindStorage(TANGENTS_OUT_BINDING);
  controls_.bindStorage(SMOOTH_CONTROLS_BINDING);
  points_.bindStorage(SMOOTH_POINTS_BINDING);
  normals_.bindStorage(SMOOTH_NORMALS_BINDING);
  tangents_.bindStorage(SMOOTH_TANGENTS_BINDING);
  const auto dispatch = [this](const gl::Program& program, GLuint more) {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    program.bind();
    for (const PieceBuffers& piece : pieces_) {
      piece.block.bindUniform(CLOTH_GRID_BINDING);
      gl::dispatch(piece.columns + more, piece.rows + more, NORMALS_GROUP_SIZE, NORMALS_GROUP_SIZE);
    }
  };
  dispatch(programs.control, 2);
  dispatch(isLean_ ? programs.leanPoints : programs.points, 0);
  if (isLean_) chooseTriangles(programs);
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
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

void SmoothSurface::drawRim() const {
  if (rim_) rim_->draw();
}

void SmoothSurface::draw() {
  for (const PieceBuffers& piece : pieces_) {
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
