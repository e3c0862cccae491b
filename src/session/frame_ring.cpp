#include "session/frame_ring.h"

#include <cassert>
#include <utility>

namespace clothsim {

void FrameRing::put(const SessionFrame& frame, Solver& solver) {
  if (!isEmpty() && frame.number < oldest()) return;
  if (!isEmpty() && frame.number <= newest()) {
    auto& entry = entries_[static_cast<std::size_t>(frame.number - oldest())];
    bytes_ -= entry.snapshot->bytes();
    entry = {frame, solver.snapshot(spareFor(solver, std::move(entry.snapshot)))};
    bytes_ += entry.snapshot->bytes();
    return;
  }
  place(frame, solver, makeRoom(solver));
}

void FrameRing::putBeyondBudget(const SessionFrame& frame, Solver& solver) {
  if (isEmpty() || frame.number > newest())
    place(frame, solver, nullptr);
  else
    put(frame, solver);
}

std::unique_ptr<Snapshot> FrameRing::spareFor(Solver& solver, std::unique_ptr<Snapshot> snapshot) {
  if (snapshot && snapshot->particles->needsContext() && solver.backend() == "cpu")
    dropped_.push_back(std::move(snapshot));
  return snapshot;
}

std::unique_ptr<Snapshot> FrameRing::makeRoom(Solver& solver) {
  std::unique_ptr<Snapshot> spare;
  while (!isEmpty() && bytes_ + entries_.back().snapshot->bytes() > budget_) {
    bytes_ -= entries_.front().snapshot->bytes();
    spare = spareFor(solver, std::move(entries_.front().snapshot));
    entries_.pop_front();
  }
  return spare;
}

void FrameRing::place(const SessionFrame& frame, Solver& solver, std::unique_ptr<Snapshot> spare) {
  assert((isEmpty() || frame.number == newest() + 1) && "frames come one after the other");
  entries_.push_back({frame, solver.snapshot(std::move(spare))});
  bytes_ += entries_.back().snapshot->bytes();
}

const FrameRing::Entry& FrameRing::at(int number) const {
  assert(!isEmpty() && number >= oldest() && number <= newest() && "only remembered frames");
  return entries_[static_cast<std::size_t>(number - oldest())];
}

void FrameRing::forgetAfter(int number, Solver& solver) {
  while (!isEmpty() && newest() > number) {
    bytes_ -= entries_.back().snapshot->bytes();
    static_cast<void>(spareFor(solver, std::move(entries_.back().snapshot)));
    entries_.pop_back();
  }
}

void FrameRing::dropOldest() {
  bytes_ -= entries_.front().snapshot->bytes();
  entries_.pop_front();
}

void FrameRing::setBudget(std::size_t bytes) {
  budget_ = bytes;
  while (entries_.size() > 1 && bytes_ > budget_) dropOldest();
}

}  // namespace clothsim
