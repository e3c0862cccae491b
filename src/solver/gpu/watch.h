// What the watchdog's passes have noted, a row a step: written on the device, copied behind the steps into
// memory that the host reads. Nothing is waited for until somebody asks.
#pragma once

#include <cstdint>
#include <optional>

#include "gl/buffer.h"
#include "gl/mapped_buffer.h"
#include "solver/divergence.h"

namespace clothsim {

class GpuWatch {
 public:
  // Needs a current context. @throws OpenGlError
  GpuWatch();

  // Binds the row of the step after `step` others. Who takes more than 1,024 steps without asking has
  // divergence looked for once in so many, which waits.
  void bind(std::uint64_t step);
  // Asks for a copy of the rows that steps have written since the last one; a barrier for buffer updates
  // stands before.
  void publish();
  [[nodiscard]] bool isPublished() const { return isCopied_; }
  // The first divergence up to and including the step after `step` steps. Waits for the copy of them.
  // @throws ContextLost
  [[nodiscard]] std::optional<Divergence> find(std::uint64_t step);
  // As far as it was looked for.
  [[nodiscard]] const std::optional<Divergence>& found() const { return divergence_; }
  // From the step after `step` others on, everything counts as sound.
  void forget(std::uint64_t step);

 private:
  struct alignas(256) Slot {  // as every driver takes storage offsets
    WatchRow row;
  };

  gl::Buffer<Slot> rows_;  // of the steps since base_
  gl::MappedBuffer<Slot> copies_;
  gl::Fence copied_;
  std::uint64_t base_ = 0;  // the step whose row is the first one; steps before it were sound
  // Rows that passes may have written to since then, and the first of them that is not copied yet, or may
  // have been written to again.
  std::size_t written_ = 0, firstUncopied_ = 0;
  bool isCopied_ = true;
  std::optional<Divergence> divergence_;
};

}  // namespace clothsim
