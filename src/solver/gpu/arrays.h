// The arrays that passes on the GPU work on (solver/pass.h), in buffers that are written through storage
// blocks and read as texels.
#pragma once

#include <array>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/mapped_buffer.h"
#include "solver/gpu/levels.h"
#include "solver/gpu/particle_array.h"
#include "solver/implicit.h"
#include "solver/pass.h"

namespace clothsim {

// What `bdf2` looks back at, as State::histories; buffers without names where that is nothing.
struct GpuHistory {
  gl::Buffer<Particle4> changes;
  gl::Buffer<ImplicitScalars<float>> scalars;  // of which usualSteps counts

  [[nodiscard]] std::size_t bytes() const { return changes.bytes() + scalars.bytes(); }
  void download(State& state) const;  // blocking
};

class GpuArrays {
 public:
  GpuArrays() = default;
  // @throws OpenGlError when a buffer is larger than the driver allows, or memory runs out
  explicit GpuArrays(std::size_t particles);

  // What implicit steps need besides. Does nothing where that is there. @throws as the constructor
  void addImplicit(std::size_t particles, const GpuLevels& levels, bool wind, bool colliders, bool history);
  // Those of a state, one a particle; without a buffer there are none.
  void setElasticSlips(const gl::Buffer<Particle4>& slips);
  // The next step is backward Euler.
  void forgetHistory();
  // Nothing touches until a step looks for it.
  void forgetPairs();
  // That of a state, where steps of second order have room for it.
  void setHistory(const State& state);
  void copyHistory(GpuHistory& copy) const;
  void restoreHistory(const GpuHistory& copy);
  // What implicit steps have come to; zeros without any. Blocking.
  [[nodiscard]] ImplicitScalars<float> scalars() const;
  // What implicit steps have counted so far, to go back to.
  void keepCounts();
  void restoreCounts();
  // Asks for a copy of them, behind what was dispatched.
  void copyScalars(gl::MappedBuffer<ImplicitScalars<float>>& copy) const;

  [[nodiscard]] ParticleArray& operator[](Array array) { return arrays_[static_cast<std::size_t>(array)]; }
  [[nodiscard]] const ParticleArray& operator[](Array array) const {
    return arrays_[static_cast<std::size_t>(array)];
  }

  // All that can be read, once a list; with `storageLoads` the state at the start as storage blocks, too.
  void bindTextures(bool storageLoads);
  // What a pass writes, and the array that it takes for the positions.
  void bindFor(Pass pass) const;
  void bindScalars() const { scalars_.bindStorage(SCALARS_BINDING); }
  // A second buffer for what is written while others still read the old: to write into it, and to take it for
  // the array.
  void addSpare(Array array);
  void bindSpare(Array array) const;
  void takeSpare(Array array);

 private:
  [[nodiscard]] bool hasHistory() const;
  void resetScalar(GLintptr offset);

  std::array<ParticleArray, ARRAY_COUNT> arrays_;  // unused ones are empty
  std::array<ParticleArray, ARRAY_COUNT> spares_;  // most are empty
  gl::Buffer<ImplicitScalars<float>> scalars_, keptScalars_;
  bool storageLoads_ = false;
};

// Where shaders find an array: the texture unit to read it from, the binding of the storage block to write it
// through; -1 where they do not.
struct ArrayPlace {
  int unit = -1, binding = -1;
};
[[nodiscard]] ArrayPlace placeOf(Array array);
// The array whose texels a pass sees as `positions`.
[[nodiscard]] Array positionsOf(Pass pass);

}  // namespace clothsim
