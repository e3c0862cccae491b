#include "solver/gpu/watch.h"

#include <algorithm>

namespace clothsim {
namespace {

constexpr std::uint64_t WATCHED_STEPS = 1024;

}  // namespace

GpuWatch::GpuWatch()
    : rows_("watchdog", WATCHED_STEPS), copies_("what the watchdog has noted", WATCHED_STEPS) {}

// What comes after divergence is of no interest and shares the last row.
void GpuWatch::bind(std::uint64_t step) {
  if (step - base_ >= WATCHED_STEPS) (void)find(step);
  const std::uint64_t row = std::min(step - base_, WATCHED_STEPS - 1);
  rows_.bindStorageRange(WATCH_BINDING, row, 1);
  written_ = std::max<std::size_t>(written_, row + 1);
  isCopied_ = false;
}

// The last row may be that of a conversion, to which the step itself writes later: it is copied again.
void GpuWatch::publish() {
  copies_.copyFrom(rows_, firstUncopied_, written_ - firstUncopied_);
  copied_.set();
  firstUncopied_ = written_ - 1;
  isCopied_ = true;
}

std::optional<Divergence> GpuWatch::find(std::uint64_t step) {
  if (divergence_) return divergence_;
  if (!isCopied_) {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    publish();
  }
  copied_.wait();
  for (std::size_t i = 0; i < written_ && !divergence_; ++i)
    divergence_ = firstDivergence(copies_.elements()[i].row, base_ + i + 1);
  if (divergence_) return divergence_;
  // Nothing was written: the rows serve again.
  base_ = step;
  written_ = firstUncopied_ = 0;
  return std::nullopt;
}

void GpuWatch::forget(std::uint64_t step) {
  static constexpr GLuint sound = NO_DIVERGENCE;
  glClearNamedBufferData(rows_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &sound);
  base_ = step;
  written_ = firstUncopied_ = 0;
  isCopied_ = true;
  divergence_.reset();
}

}  // namespace clothsim
