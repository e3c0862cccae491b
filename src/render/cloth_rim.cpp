#include "render/cloth_rim.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include "render/pieces.h"

namespace clothsim {
namespace {

// Corners of a border that comes back to its beginning.
std::vector<BorderCorner> closed(const std::vector<std::uint32_t>& points) {
  std::vector<BorderCorner> corners;
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    corners.push_back(
        {points[(i + count - 1) % count], points[i], points[next], static_cast<std::uint32_t>(next)});
  }
  return corners;
}

// Whether texture coordinates turn the other way than the front: by the area that the border goes around.
bool isMirrored(const std::vector<BorderCorner>& corners, std::span<const std::array<float, 2>> of) {
  double area = 0;
  for (const BorderCorner& corner : corners) {
    const auto &a = of[corner.here], &b = of[corner.after];
    area += static_cast<double>(a[0]) * static_cast<double>(b[1]) -
            static_cast<double>(a[1]) * static_cast<double>(b[0]);
  }
  return area < 0;
}

// Texture coordinates of a corner's points: the tube goes outwards and comes back.
void appendCoordinates(const BorderCorner& corner, const shared::ClothPiece& piece,
                       std::span<const std::array<float, 2>> of, bool mirrored,
                       std::vector<std::array<float, 2>>& coordinates) {
  const auto at = [&](std::uint32_t point) {
    return glm::vec2(of[point][0] * piece.width, of[point][1] * piece.height);
  };
  const glm::vec2 along = at(corner.after) - at(corner.before);
  const float length = std::max(glm::length(along), 1e-9f), turn = mirrored ? -1.0f : 1.0f;
  const glm::vec2 outwards = turn * glm::vec2(along.y, -along.x) / length;
  for (unsigned k = 0; k < RIM_POINTS; ++k) {
    const unsigned step = k < RIM_POINTS / 2 ? k : k - 1;  // the middle is there twice
    const auto part = std::sin(std::numbers::pi_v<float> * static_cast<float>(step) / (RIM_POINTS - 2));
    const glm::vec2 place = at(corner.here) + piece.halfThickness * part * outwards;
    coordinates.push_back({place.x / std::max(piece.width, 1e-9f), place.y / std::max(piece.height, 1e-9f)});
  }
}

// Between a corner's points and the next one's. The front half is counterclockwise from outside, the back
// half the other way around, so that each has the colour of its side.
void appendTriangles(std::uint32_t here, std::uint32_t next, std::vector<std::uint32_t>& indices) {
  for (std::uint32_t k = 0; k + 1 < RIM_POINTS; ++k) {
    if (k + 1 == RIM_POINTS / 2) continue;
    const std::uint32_t a = here + k, b = next + k, c = next + k + 1, d = here + k + 1;
    const bool isFront = k < RIM_POINTS / 2;
    if (isFront)
      indices.insert(indices.end(), {a, c, b, a, d, c});
    else
      indices.insert(indices.end(), {a, b, c, a, c, d});
  }
}

}  // namespace

std::vector<BorderCorner> borderOfGrid(const Piece& points) {
  std::vector<std::uint32_t> around;
  const int right = points.columns - 1, bottom = points.rows - 1;
  for (int row = 0; row < bottom; ++row) around.push_back(points.particle(0, row));
  for (int column = 0; column < right; ++column) around.push_back(points.particle(column, bottom));
  for (int row = bottom; row > 0; --row) around.push_back(points.particle(right, row));
  for (int column = right; column > 0; --column) around.push_back(points.particle(column, 0));
  if (points.rowsGoUp) std::reverse(around.begin(), around.end());
  return closed(around);
}

std::vector<float> drawnThickness(const Scene& scene, const Cloth& cloth) {
  std::vector<float> thickness;
  for (std::size_t i = 0; i < cloth.pieces().size(); ++i) {
    const Piece& piece = cloth.pieces()[i];
    const ClothSettings& settings = scene.cloths[i];
    const double own = settings.thicknessInUse();
    const double spacing = std::min(piece.nominalLength[toLeft], piece.nominalLength[toUpper]);
    const std::optional<double> wanted =
        settings.render.thickness ? settings.render.thickness : scene.render.thickness;
    thickness.push_back(static_cast<float>(wanted.value_or(std::min(own, spacing / 2))));
  }
  return thickness;
}

ClothRim::ClothRim(std::span<const Strip> strips, std::span<const std::array<float, 2>> textureCoordinates) {
  std::vector<glm::uvec4> corners;
  std::vector<std::array<float, 2>> coordinates;
  std::vector<std::uint32_t> indices;
  for (const Strip& strip : strips) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    std::array block{strip.block};
    block[0].halfThickness = 0;  // these points are where they are drawn
    pieces_.push_back({gl::Buffer<shared::ClothPiece>("rim piece", block), indices.size(), 0});
    const bool mirrored = isMirrored(strip.corners, textureCoordinates);
    for (std::uint32_t i = 0; i < strip.corners.size(); ++i) {
      const BorderCorner& corner = strip.corners[i];
      appendCoordinates(corner, strip.block, textureCoordinates, mirrored, coordinates);
      appendTriangles(RIM_POINTS * (first + i), RIM_POINTS * (first + corner.next), indices);
      corners.emplace_back(corner.before, corner.here, corner.after,
                           std::bit_cast<std::uint32_t>(strip.block.halfThickness));
    }
    pieces_.back().indexCount = indices.size() - pieces_.back().firstIndex;
  }
  corners_ = gl::Buffer<glm::uvec4>("rim corners", corners);
  points_ = gl::Buffer<glm::vec4>("rim points", coordinates.size());
  normals_ = gl::Buffer<glm::vec4>("rim normals", coordinates.size());
  tangents_ = gl::Buffer<glm::vec4>("rim tangents", coordinates.size());
  textureCoordinates_ = gl::Buffer<std::array<float, 2>>("rim texture coordinates", coordinates);
  indices_ = gl::Buffer<std::uint32_t>("rim indices", indices);
  vertices_.attach(points_.name(), {.location = POSITION_LOCATION});
  vertices_.attach(normals_.name(), {.location = NORMAL_LOCATION});
  vertices_.attach(tangents_.name(), {.location = TANGENT_LOCATION});
  vertices_.attach(textureCoordinates_.name(),
                   {.location = TEXTURE_COORDINATE_LOCATION, .components = 2, .stride = 8});
  vertices_.attachIndices(indices_.name());
}

void ClothRim::compute(const gl::Program& program, GLuint positions, GLuint normals, GLuint tangents) {
  if (corners_.size() == 0) return;
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_POSITIONS_BINDING, positions);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_OUT_BINDING, normals);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TANGENTS_OUT_BINDING, tangents);
  corners_.bindStorage(RIM_CORNERS_BINDING);
  points_.bindStorage(SMOOTH_POINTS_BINDING);
  normals_.bindStorage(SMOOTH_NORMALS_BINDING);
  tangents_.bindStorage(SMOOTH_TANGENTS_BINDING);
  program.bind();
  gl::dispatch(corners_.size(), SMOOTH_GROUP);
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

void ClothRim::draw(std::optional<std::size_t> only) const {
  vertices_.bind();
  for (const PieceBuffers& piece : piecesOf(std::span(pieces_), only)) {
    if (piece.indexCount == 0) continue;
    piece.block.bindUniform(CLOTH_GRID_BINDING);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(piece.indexCount), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(piece.firstIndex * sizeof(std::uint32_t)));
  }
}

}  // namespace clothsim
