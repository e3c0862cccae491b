// The coarse levels of the implicit integrator's preconditioner on the GPU: what is fixed
// (solver/hierarchy.h), in buffers that are read as texels.
#pragma once

#include <algorithm>
#include <vector>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "solver/hierarchy.h"

namespace clothsim {

class GpuLevels {
 public:
  GpuLevels() = default;
  // One work group takes levels of at most `verticesAlone` vertices alone. @throws OpenGlError when a buffer
  // is larger than the driver allows, or memory runs out
  GpuLevels(const Hierarchy<float>& hierarchy, std::uint32_t verticesAlone);

  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] const std::vector<LevelParams>& ofPiece(std::size_t piece) const { return pieces_[piece]; }
  [[nodiscard]] std::size_t parts() const { return parts_.buffer.size(); }  // of all coarsest levels
  // The levels to which a piece is restricted one by one, finest first; further ones go with the last of
  // them.
  [[nodiscard]] std::size_t rowsOf(std::size_t piece) const { return rows_[piece]; }
  [[nodiscard]] std::size_t mostRows() const {  // of all pieces
    return rows_.empty() ? 0 : *std::ranges::max_element(rows_);
  }
  [[nodiscard]] std::uint32_t vertices() const { return coarseVertices_; }
  [[nodiscard]] std::size_t blocks() const { return blocks_.buffer.size(); }
  [[nodiscard]] std::uint32_t denseEntries() const { return denseEntries_; }

  // The lists, for all passes.
  void bind() const;
  // The parameters of a level, alone or with those that go with it.
  void bindLevel(std::size_t piece, std::size_t level) const;
  void bindRow(std::size_t piece, std::size_t level) const;

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
  struct alignas(256) RowSlot {
    LevelsInARow row;
  };

  std::vector<std::vector<LevelParams>> pieces_;
  std::uint32_t coarseVertices_ = 0, denseEntries_ = 0;
  std::vector<std::size_t> rows_;                     // by piece
  std::vector<std::size_t> firstLevels_, firstRows_;  // by piece, in
  gl::Buffer<LevelSlot> levelSlots_;
  gl::Buffer<RowSlot> rowSlots_;
  Texels<DensePart> parts_;
  Texels<std::uint32_t> prolongationStarts_, restrictionStarts_, sources_;
  Texels<Hierarchy<float>::Weight> prolongation_, restriction_;
  Texels<Hierarchy<float>::Block> blocks_;
};

}  // namespace clothsim
