// The lists of meshes (solver/mesh_lists.h) in buffers that passes read as texels.
#pragma once

#include <array>
#include <cstdint>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "solver/mesh_lists.h"

namespace clothsim {

class GpuMeshLists {
 public:
  GpuMeshLists() = default;
  // Without meshes and seams there are no buffers. @throws OpenGlError when one is larger than the driver
  // allows
  explicit GpuMeshLists(const Cloth& cloth, const Cuts& cuts = {});

  void bind() const;

 private:
  struct Texels {  // a uvec4 an element, floats by their bits; `numbers` one word
    gl::Buffer<std::array<std::uint32_t, 4>> buffer;
    gl::BufferTexture texture;
  };
  template <class Element>
  static Texels texels(const char* label, const std::vector<Element>& elements);

  void addSeams(const Cloth& cloth, const MeshLists<float>& lists);

  bool any_ = false, anySeams_ = false;
  Texels starts_, springs_, hinges_, triangles_, limited_, seams_;
  gl::Buffer<std::uint32_t> numbers_;
  gl::BufferTexture numbersTexture_;
  gl::Buffer<std::array<float, 4>> places_;
  gl::BufferTexture placesTexture_;
};

}  // namespace clothsim
