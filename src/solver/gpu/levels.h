// The coarse levels of the implicit integrator's preconditioner on the GPU: what is fixed
// (solver/hierarchy.h), in buffers that are read as texels.
#pragma once

#include <vector>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "solver/hierarchy.h"

namespace clothsim {

class GpuLevels {
 public:
  GpuLevels() = default;
  // @throws OpenGlError when a buffer is larger than the driver allows, or memory runs out
  explicit GpuLevels(const Hierarchy<float>& hierarchy);

  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] const std::vector<LevelParams>& ofPiece(std::size_t piece) const { return pieces_[piece]; }
  [[nodiscard]] const std::vector<DensePart>& partsOf(std::size_t piece) const { return parts_[piece]; }
  [[nodiscard]] std::uint32_t vertices() const { return coarseVertices_; }
  [[nodiscard]] std::size_t blocks() const { return blocks_.buffer.size(); }
  [[nodiscard]] std::uint32_t denseEntries() const { return denseEntries_; }

  // The lists, for all passes.
  void bind() const;
  // The parameters of a level, or of a part of the coarsest one.
  void bindLevel(std::size_t piece, std::size_t level) const;
  void bindPart(std::size_t piece, std::size_t part) const;

 private:
  template <class Element>
  struct Texels {
    gl::Buffer<Element> buffer;
    gl::BufferTexture texture;
  };
  template <class Element>
  [[nodiscard]] static Texels<Element> texels(const char* label, const std::vector<Element>& elements,
                                              GLenum format);
  struct alignas(256) LevelSlot {  // every driver takes uniform offsets in multiples of 256
    LevelParams params;
  };
  struct alignas(256) PartSlot {
    DensePart part;
  };

  std::vector<std::vector<LevelParams>> pieces_;
  std::vector<std::vector<DensePart>> parts_;
  std::uint32_t coarseVertices_ = 0, denseEntries_ = 0;
  std::vector<std::size_t> firstLevels_, firstParts_;  // by piece, in
  gl::Buffer<LevelSlot> levelSlots_;
  gl::Buffer<PartSlot> partSlots_;
  Texels<std::uint32_t> prolongationStarts_, restrictionStarts_, sources_;
  Texels<Hierarchy<float>::Weight> prolongation_, restriction_;
  Texels<Hierarchy<float>::Block> blocks_;
};

}  // namespace clothsim
