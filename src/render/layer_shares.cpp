#include "render/layer_shares.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace clothsim {
namespace {

// From the center of a right-angled triangle to its farthest corner, and how far layers that count are from
// each other [cells]: twice what the smooth surface leaves the triangles by, of two layers together.
constexpr double CENTER_TO_CORNER = 0.75, MOST_DISTANCE = 0.35;
// Of two layers the farther bulge is half of both, which together may take half of the distance; and squeezed
// layers are nearer than contact wants them, by half.
constexpr double BULGE_OF_DISTANCE = 1.0 / 8;

double cellOf(const Piece& piece) {
  const double mean = std::max({piece.nominalLength[toLeft], piece.nominalLength[toUpper], 1e-9});
  return piece.isMesh ? std::max(mean, 0.7 * piece.longestEdge) : mean;
}

// In cells of their pieces, which are far from each other.
std::vector<glm::vec4> restPlacesOf(const Cloth& cloth) {
  constexpr double betweenPieces = 16384;
  std::vector<glm::vec4> places;
  places.reserve(cloth.particleCount());
  double shift = 0;
  for (const Piece& piece : cloth.pieces()) {
    const Vec3d first = cloth.positions()[piece.firstParticle];
    for (std::uint32_t i = 0; i < piece.particleCount(); ++i) {
      const Vec3d p = (1 / cellOf(piece)) * (cloth.positions()[piece.firstParticle + i] - first);
      places.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z + shift),
                          0);
    }
    shift += betweenPieces;
  }
  return places;
}

}  // namespace

LayerShares::LayerShares(const Cloth& cloth, std::span<const std::array<std::uint32_t, 3>> triangles,
                         double distance)
    : restPlaces_("layers at rest", restPlacesOf(cloth)) {
  double cell = 0;
  for (const Piece& piece : cloth.pieces()) cell = std::max(cell, cellOf(piece));
  const auto count = static_cast<std::uint32_t>(triangles.size());
  const double radius = (CENTER_TO_CORNER + MOST_DISTANCE) * cell;
  shared::LayerSearch search{};
  search.triangles = count;
  search.buckets = std::bit_ceil(std::max(count / 4, 64u));
  search.perBucket = static_cast<float>(0.5 / radius);
  search.radius = static_cast<float>(radius);
  search.centerToCorner = static_cast<float>(CENTER_TO_CORNER * cell);
  search.leastBulge = static_cast<float>(BULGE_OF_DISTANCE * distance);
  search_ = gl::Buffer<shared::LayerSearch>("layer search", std::span(&search, 1));
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const auto& triangle : triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  corners_ = gl::Buffer<std::uint32_t>("layer triangles", corners);
  heads_ = gl::Buffer<std::uint32_t>("layer buckets", search.buckets);
  entries_ = gl::Buffer<glm::vec4>("layer entries", count);
  bulges_ = gl::Buffer<glm::vec4>("layer bulges", count);
  before_ = gl::Buffer<float>("layer shares before", cloth.particleCount());
  shares_ = gl::Buffer<float>("layer shares", cloth.particleCount());
}

void LayerShares::bindBulges() const {
  corners_.bindStorage(LAYER_TRIANGLES_BINDING);
  bulges_.bindStorage(LAYER_BULGES_BINDING);
}

void LayerShares::compute(const LayerPrograms& programs, GLuint positions) {
  const std::uint32_t none = 0;
  const float all = 1;
  const std::size_t triangles = entries_.size();
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // shaders' accesses for the state before
  glClearNamedBufferData(heads_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
  glClearNamedBufferData(shares_.name(), GL_R32F, GL_RED, GL_FLOAT, &all);
  search_.bindUniform(LAYER_SEARCH_BINDING);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NORMALS_POSITIONS_BINDING, positions);
  bindBulges();
  entries_.bindStorage(LAYER_ENTRIES_BINDING);
  heads_.bindStorage(LAYER_HEADS_BINDING);
  restPlaces_.bindStorage(LAYER_REST_BINDING);
  before_.bindStorage(LAYER_BEFORE_BINDING);
  shares_.bindStorage(LAYER_SHARES_BINDING);
  programs.insert.bind();
  gl::dispatch(triangles, SMOOTH_GROUP);
  for (const gl::Program* program : {&programs.share, &programs.shareAgain}) {
    program->bind();
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    before_.copyFrom(shares_);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    gl::dispatch(triangles, SMOOTH_GROUP);
  }
}

}  // namespace clothsim
