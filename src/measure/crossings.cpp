#include "measure/crossings.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "cloth/seam_neighbours.h"
#include "core/error.h"
#include "core/thread_team.h"

#ifdef CLOTHSIM_HAS_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#endif

namespace clothsim {

void CrossingSummary::add(int frame, const CrossingCount& count) {
  ++framesChecked;
  worst = std::max(worst, count.apart);
  total += count.apart;
  neighbours = std::max(neighbours, count.neighbours);
  if (count.apart > 0 && !firstFrame) firstFrame = frame;
}

bool CrossingCounter::areNeighbours(const Triangle& a, const Triangle& b) const {
  for (const std::uint32_t i : a) {
    const Place& p = places_[i];
    for (const std::uint32_t j : b) {
      const Place& q = places_[j];
      if (joints_[i] == joints_[j]) return true;
      if (cloth_->hasMesh() && p.piece == q.piece && cloth_->pieces()[p.piece].isMesh) {
        if (i == j || cloth_->lists().joins(i, j)) return true;
      } else if (p.piece == q.piece && std::abs(p.column - q.column) <= 1 && std::abs(p.row - q.row) <= 1) {
        return true;
      }
    }
  }
  return false;
}

#ifdef CLOTHSIM_HAS_CGAL

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using TriangleBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
using Triangle = std::array<std::uint32_t, 3>;
using Pair = std::array<std::uint32_t, 2>;

Kernel::Triangle_3 solid(const std::vector<Point>& points, const Triangle& t) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

// The corners of a triangle, beginning with those that the other triangle shares, and the number of these.
int sharedFirst(Triangle& t, const Triangle& other) {
  const auto end = std::stable_partition(t.begin(), t.end(), [&](std::uint32_t i) {
    return std::find(other.begin(), other.end(), i) != other.end();
  });
  return static_cast<int>(end - t.begin());
}

// Whether they cross beyond what they share. The rules are those of CGAL's Polygon_mesh_processing.
bool cross(const std::vector<Point>& points, Triangle a, Triangle b) {
  const Triangle ofA = a;
  const int shared = sharedFirst(a, b);
  sharedFirst(b, ofA);
  if (shared == 0) return CGAL::do_intersect(solid(points, a), solid(points, b));
  if (shared == 1)
    return CGAL::do_intersect(solid(points, a), Kernel::Segment_3(points[b[1]], points[b[2]])) ||
           CGAL::do_intersect(solid(points, b), Kernel::Segment_3(points[a[1]], points[a[2]]));
  const Point &p = points[a[0]], &q = points[a[1]], &r = points[a[2]], &s = points[b[2]];
  return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
}

}  // namespace

bool CrossingCounter::available() { return true; }

CrossingCounter::CrossingCounter(const Shared<Cloth>& cloth) : cloth_(cloth), joints_(seamJoints(*cloth)) {
  for (std::uint32_t piece = 0; piece < cloth->pieces().size(); ++piece)
    for (int row = 0; row < cloth->pieces()[piece].rows; ++row)
      for (int column = 0; column < cloth->pieces()[piece].columns; ++column)
        places_.push_back({piece, column, row});
}

CrossingCount CrossingCounter::count(const State& state) const {
  std::vector<Point> points;
  points.reserve(state.positions.size());
  for (const Particle4& x : state.positions) points.emplace_back(x.x, x.y, x.z);  // exact: binary32 to double
  const std::vector<Triangle> triangles = remainingTriangles(*cloth_, state.cuts);
  std::vector<TriangleBox> boxes;
  boxes.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    if (!CGAL::collinear(points[a], points[b], points[c]))
      boxes.emplace_back(solid(points, triangles[i]).bbox(), i);
  }
  std::vector<Pair> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const TriangleBox& a, const TriangleBox& b) {
    pairs.push_back({a.info(), b.info()});
  });

  std::atomic<std::uint64_t> apart = 0, neighbours = 0;
  constexpr std::uint32_t pairsAtOnce = 1024;
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(pairs.size()), pairsAtOnce,
                               [&](std::uint32_t i) {
                                 const Triangle &a = triangles[pairs[i][0]], &b = triangles[pairs[i][1]];
                                 if (cross(points, a, b)) ++(areNeighbours(a, b) ? neighbours : apart);
                               });
  return {apart, neighbours};
}

#else

bool CrossingCounter::available() { return false; }

CrossingCounter::CrossingCounter(const Shared<Cloth>& cloth) : cloth_(cloth) {
  throw UsageError(
      "counting crossings needs CGAL, which this program was built without. Install it (Debian: libcgal-dev; "
      "tools/setup --test does) and build again.");
}

CrossingCount CrossingCounter::count(const State&) const { return {}; }

#endif

}  // namespace clothsim
