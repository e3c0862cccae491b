// How many pairs of triangles of a state cross: decided by exact predicates (CGAL), not by tolerances. A tool
// for checking runs and for tests; no step depends on it. Built without CGAL, it only says that it cannot.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cloth/cloth.h"
#include "core/shared.h"
#include "solver/state.h"

namespace clothsim {

// Pairs of triangles that have a point in common; those that only touch do, too. Triangles of zero area are
// left out: what crosses them, crosses the triangles at their edges.
struct CrossingCount {
  std::uint64_t apart = 0;  // pairs that are no neighbours on the cloth
  // Pairs of which some particles are the same or lie at most one column and one row from each other on the
  // same grid. What they share by their making does not count: with a common particle, an edge across from it
  // must reach the other triangle; with a common edge, one must lie folded onto the other, in one plane.
  std::uint64_t neighbours = 0;
  friend bool operator==(const CrossingCount&, const CrossingCount&) = default;
};

class CrossingCounter {
 public:
  // Whether this program was built with CGAL.
  [[nodiscard]] static bool available();
  // @throws UsageError, naming the package to install, when it was not
  explicit CrossingCounter(const Shared<Cloth>& cloth);

  // Of a state whose positions are finite. Triangles that are cut away do not count; the rest may cross
  // across a cut, as neighbours.
  [[nodiscard]] CrossingCount count(const State& state) const;

 private:
  struct Place {
    std::uint32_t grid;
    int column, row;
  };
  using Triangle = std::array<std::uint32_t, 3>;
  [[nodiscard]] bool areNeighbours(const Triangle& a, const Triangle& b) const;

  Shared<Cloth> cloth_;
  std::vector<Place> places_;  // by particle
};

// Over the frames of a run.
struct CrossingSummary {
  int framesChecked = 0;
  std::uint64_t worst = 0;  // most pairs apart at the end of a frame,
  std::uint64_t total = 0;  // and their sum over all of them
  std::optional<int> firstFrame;
  std::uint64_t neighbours = 0;  // most pairs of neighbours

  void add(int frame, const CrossingCount& count);
};

}  // namespace clothsim
