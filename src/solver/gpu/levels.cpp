#include "solver/gpu/levels.h"

#include <span>

#include "solver/gpu/particle_array.h"

namespace clothsim {

template <class Element>
GpuLevels::Texels<Element> GpuLevels::texels(const char* label, const std::vector<Element>& elements,
                                             GLenum format) {
  checkFits(elements.size(), sizeof(Element), label);
  Texels<Element> result;
  result.buffer = gl::Buffer<Element>(label, std::span<const Element>(elements));
  result.texture = gl::BufferTexture(label, result.buffer.name(), format);
  return result;
}

GpuLevels::GpuLevels(const Hierarchy<float>& hierarchy)
    : pieces_(hierarchy.pieces),
      parts_(hierarchy.parts),
      coarseVertices_(hierarchy.coarseVertices),
      denseEntries_(hierarchy.denseEntries) {
  std::vector<LevelSlot> levels;
  std::vector<PartSlot> parts;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    firstLevels_.push_back(levels.size());
    firstParts_.push_back(parts.size());
    for (const LevelParams& level : pieces_[piece]) levels.push_back({level});
    for (const DensePart& part : parts_[piece]) parts.push_back({part});
  }
  levelSlots_ = gl::Buffer<LevelSlot>("levels", std::span<const LevelSlot>(levels));
  partSlots_ = gl::Buffer<PartSlot>("parts of the coarsest levels", std::span<const PartSlot>(parts));
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
}

void GpuLevels::bindLevel(std::size_t piece, std::size_t level) const {
  levelSlots_.bindUniformRange(LEVEL_PARAMS_BINDING, firstLevels_[piece] + level, 1);
}

void GpuLevels::bindPart(std::size_t piece, std::size_t part) const {
  partSlots_.bindUniformRange(LEVEL_PARAMS_BINDING, firstParts_[piece] + part, 1);
}

}  // namespace clothsim
