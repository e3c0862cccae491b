#include "solver/gpu/hand.h"

#include <cassert>

namespace clothsim {

void GpuHand::set(const Hand& hand) {
  const bool otherBlock = hand.hold && (!hand_.hold || hand.hold->points != hand_.hold->points);
  hand_ = hand;
  if (!isIdle() && slots_.name() == 0) {
    slots_ = gl::Buffer<Slot>("hand parameters", MOST_STEPS);
    staged_.resize(MOST_STEPS);
  }
  if (!otherBlock) return;
  held_ = gl::Buffer<Hold::Point>("held points", std::span<const Hold::Point>(*hand.hold->points));
  heldTexture_ = gl::BufferTexture("held points", held_.name(), GL_RGBA32F);
}

void GpuHand::upload(const Scene& scene, std::uint64_t firstStep, std::size_t count) {
  if (isIdle()) return;
  assert(count <= MOST_STEPS && "a batch of steps must fit");
  for (std::size_t k = 0; k < count; ++k)
    staged_[k].params = makeHandParams<float>(hand_, scene, firstStep + k);
  slots_.upload({staged_.data(), count});
}

void GpuHand::bind(std::size_t batchStep) const {
  if (isIdle()) return;
  slots_.bindUniformRange(HAND_PARAMS_BINDING, batchStep, 1);
  if (hand_.hold) heldTexture_.bind(HELD_UNIT);
}

void GpuCuts::set(const Cuts& cuts, const std::vector<std::uint32_t>& masks) {
  cuts_ = cuts;
  if (masks.empty()) return;
  if (masks_.size() != masks.size()) {
    masks_ = gl::Buffer<std::uint32_t>("cut masks", masks.size());
    texture_ = gl::BufferTexture("cut masks", masks_.name(), GL_R32UI);
  }
  masks_.upload(masks);
}

void GpuCuts::bind() const {
  if (!cuts_.empty()) texture_.bind(CUT_MASKS_UNIT);
}

}  // namespace clothsim
