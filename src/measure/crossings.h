// Counts the pairs of triangles of a state that cross, by the exact predicates of CGAL and not by tolerances.
// It checks runs and serves tests; no step depends on it. Built without CGAL it throws.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cloth/cloth.h"
#include "core/shared.h"
#include "solver/state.h"

namespace clothsim {

// Pairs of triangles that have a point in common, also where they only touch. Triangles of zero area are not
// counted: whatever crosses them crosses the triangles at their edges.
struct CrossingCount {
  std::uint64_t apart = 0;  // pairs that are not neighbours
  // Pairs in which some particles are the same, or lie on one grid at most one column and one row apart. The
  // common corner or edge itself is no crossing: with a common particle, the edge opposite to it must reach
  // the other triangle; with a common edge, one triangle must lie folded onto the other in one plane.
  std::uint64_t neighbours = 0;
  friend bool operator==(const CrossingCount&, const CrossingCount&) = default;
};

class CrossingCounter {
 public:
  // Whether this program was built with CGAL.
  [[nodiscard]] static bool available();
  // @throws UsageError that names the package to install when the program was built without CGAL
  explicit CrossingCounter(const Shared<Cloth>& cloth);

  // The positions of the state must be finite. Triangles with a cut side are not counted. Triangles on the
  // two sides of a cut count as neighbours, and those that share a sewn point.
  [[nodiscard]] CrossingCount count(const State& state) const;

 private:
  struct Place {
    std::uint32_t piece;
    int column, row;
  };
  using Triangle = std::array<std::uint32_t, 3>;
  [[nodiscard]] bool areNeighbours(const Triangle& a, const Triangle& b) const;

  Shared<Cloth> cloth_;
  std::vector<Place> places_;          // of each particle
  std::vector<std::uint32_t> joints_;  // seamJoints()
};

// Sums up the counts over the frames of a run.
struct CrossingSummary {
  int framesChecked = 0;
  std::uint64_t worst = 0;  // the largest `apart` of a frame
  std::uint64_t total = 0;  // the sum of `apart` over all frames
  std::optional<int> firstFrame;
  std::uint64_t neighbours = 0;  // the largest of a frame

  void add(int frame, const CrossingCount& count);
};

}  // namespace clothsim
