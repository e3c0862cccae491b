// What a hand does to the cloth, and the cuts in it, as the passes on the GPU read them. While nobody holds
// or blows or has cut, nothing is uploaded and no pass looks.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "scene/scene.h"
#include "solver/hand.h"

namespace clothsim {

class GpuHand {
 public:
  void set(const Hand& hand);
  [[nodiscard]] const Hand& hand() const { return hand_; }
  [[nodiscard]] bool isIdle() const { return !hand_.hold && !hand_.jet; }

  // For the steps from `firstStep` on, `count` of them, at most MOST_STEPS.
  void upload(const Scene& scene, std::uint64_t firstStep, std::size_t count);
  // For one of them.
  void bind(std::size_t batchStep) const;

  static constexpr std::size_t MOST_STEPS = 64;

 private:
  struct alignas(256) Slot {  // every driver takes uniform offsets in multiples of 256
    HandParams<float> params;
  };

  Hand hand_;
  gl::Buffer<Hold::Point> held_;
  gl::BufferTexture heldTexture_;
  gl::Buffer<Slot> slots_;
  std::vector<Slot> staged_;
};

class GpuCuts {
 public:
  // `masks`: makeCutMasks().
  void set(const Cuts& cuts, const std::vector<std::uint32_t>& masks);
  [[nodiscard]] const Cuts& cuts() const { return cuts_; }
  void bind() const;

 private:
  Cuts cuts_;
  gl::Buffer<std::uint32_t> masks_;
  gl::BufferTexture texture_;
};

}  // namespace clothsim
