#include "solver/gpu/levels.h"

#include <span>

#include "solver/gpu/particle_array.h"

namespace clothsim {
namespace {

// The first level that one work group can do with all that follow; never the finest.
std::size_t firstLevelAlone(const std::vector<LevelParams>& levels, std::uint32_t verticesAlone) {
  std::size_t first = levels.size();
  while (first > 1 && levels.size() - first < LEVELS_ALONE && levels[first - 1].fineCount <= verticesAlone)
    --first;
  return first;
}

LevelsInARow rowOf(const std::vector<LevelParams>& levels, std::size_t first, std::size_t end) {
  LevelsInARow row{};
  row.count = static_cast<std::uint32_t>(end - first);
  for (std::size_t n = first; n < end; ++n) row.levels[n - first] = levels[n];
  return row;
}

}  // namespace

template <class Element>
GpuLevels::Texels<Element> GpuLevels::texels(const char* label, const std::vector<Element>& elements,
                                             GLenum format) {
  checkTexelsFit(elements.size(), label);
  Texels<Element> result;
  result.buffer = gl::Buffer<Element>(label, std::span<const Element>(elements));
  result.texture = gl::BufferTexture(label, result.buffer.name(), format);
  return result;
}

GpuLevels::GpuLevels(const Hierarchy<float>& hierarchy, std::uint32_t verticesAlone)
    : pieces_(hierarchy.pieces),
      coarseVertices_(hierarchy.coarseVertices),
      denseEntries_(hierarchy.denseEntries) {
  std::vector<LevelSlot> levels;
  std::vector<RowSlot> rows;
  std::vector<DensePart> parts;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    const std::vector<LevelParams>& own = pieces_[piece];
    firstLevels_.push_back(levels.size());
    firstRows_.push_back(rows.size());
    rows_.push_back(firstLevelAlone(own, verticesAlone));
    for (const LevelParams& level : own) levels.push_back({level});
    for (std::size_t n = 0; n < rows_.back(); ++n) rows.push_back({rowOf(own, n, n + 1)});
    LevelsInARow& last = rows.back().row = rowOf(own, rows_.back() - 1, own.size());
    last.firstPart = static_cast<std::uint32_t>(parts.size());
    parts.insert(parts.end(), hierarchy.parts[piece].begin(), hierarchy.parts[piece].end());
    last.endPart = static_cast<std::uint32_t>(parts.size());
  }
  levelSlots_ = gl::Buffer<LevelSlot>("levels", std::span<const LevelSlot>(levels));
  rowSlots_ = gl::Buffer<RowSlot>("levels in a row", std::span<const RowSlot>(rows));
  parts_ = texels("parts of the coarsest levels", parts, GL_RGBA32UI);
  parts_.texture.attach(parts_.buffer.name(), GL_RGBA32UI, parts_.buffer.bytes());  // shaders ask how many
  prolongationStarts_ = texels("starts of prolongation", hierarchy.prolongationStarts, GL_R32UI);
  prolongation_ = texels("prolongation", hierarchy.prolongation, GL_RG32UI);
  restrictionStarts_ = texels("starts of restriction", hierarchy.restrictionStarts, GL_R32UI);
  restriction_ = texels("restriction", hierarchy.restriction, GL_RG32UI);
  blocks_ = texels("blocks of levels", hierarchy.blocks, GL_RGBA32UI);
  sources_ = texels("sources of blocks", hierarchy.sources, GL_R32UI);
}

void GpuLevels::bind() const {
  if (empty()) return;
  prolongationStarts_.texture.bind(PROLONGATION_STARTS_UNIT);
  prolongation_.texture.bind(PROLONGATION_UNIT);
  restrictionStarts_.texture.bind(RESTRICTION_STARTS_UNIT);
  restriction_.texture.bind(RESTRICTION_UNIT);
  blocks_.texture.bind(COARSE_PAIRS_UNIT);
  sources_.texture.bind(COARSE_SOURCES_UNIT);
  parts_.texture.bind(DENSE_PARTS_UNIT);
}

void GpuLevels::bindLevel(std::size_t piece, std::size_t level) const {
  levelSlots_.bindUniformRange(LEVEL_PARAMS_BINDING, firstLevels_[piece] + level, 1);
}

void GpuLevels::bindRow(std::size_t piece, std::size_t level) const {
  rowSlots_.bindUniformRange(LEVEL_PARAMS_BINDING, firstRows_[piece] + level, 1);
}

}  // namespace clothsim
