// Work on several cloths as one job of the threads: each alone may be too small to share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/thread_team.h"

namespace clothsim::cpu {

// Entries [begin, end) of a cloth: rows, particles, vertices.
struct PieceRange {
  std::uint32_t piece, begin, end;
};

class PieceRanges {
 public:
  void clear() { all_.clear(); }
  void add(std::uint32_t piece, std::uint32_t first, std::uint32_t count) {
    all_.push_back({{piece, first, first + count}, size()});
  }
  // Of all that was added; entries are numbered in its order.
  [[nodiscard]] std::uint32_t size() const {
    return all_.empty() ? 0 : all_.back().start + (all_.back().whole.end - all_.back().whole.begin);
  }

  // body(range) for all entries in [first, end), in any order, on all threads, of which each takes so many
  // at once.
  template <class Body>
  void forEach(std::uint32_t first, std::uint32_t end, std::uint32_t atOnce, const Body& body) const {
    ThreadTeam::shared().forEachRange(first, end, atOnce, [&](std::uint32_t begin, std::uint32_t stop) {
      const auto isBehind = [](std::uint32_t entry, const Numbered& one) { return entry < one.start; };
      for (auto of = std::upper_bound(all_.begin(), all_.end(), begin, isBehind) - 1; begin < stop; ++of) {
        const PieceRange& whole = of->whole;
        const std::uint32_t from = whole.begin + (begin - of->start),
                            to = std::min(whole.end, whole.begin + (stop - of->start));
        if (from < to) body(PieceRange{whole.piece, from, to});
        begin += to - from;
      }
    });
  }
  template <class Body>
  void forEach(std::uint32_t atOnce, const Body& body) const {
    if (size() > 0) forEach(0, size(), atOnce, body);
  }

 private:
  struct Numbered {
    PieceRange whole;
    std::uint32_t start;  // number of its first entry
  };
  std::vector<Numbered> all_;
};

}  // namespace clothsim::cpu
