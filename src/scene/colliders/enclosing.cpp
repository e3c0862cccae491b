#include "scene/colliders/enclosing.h"

#include <algorithm>
#include <cmath>

#include "core/exact_math.h"
#include "core/vector_clones.h"

namespace clothsim {
namespace {

constexpr double POINTS_A_CELL = 6;  // along a side of a triangle
constexpr double MOST_CELLS = 0.5;   // by which one point of a triangle lowers a distance
// Before that, distances are fitted to 0 on the triangles from both sides, so that little is left to lower.
constexpr double FITTED_POINTS_A_CELL = 3;
constexpr int FITS = 3;
constexpr double SHARE_OF_FIT = 0.3;
constexpr std::array partsOfWay{0.25, 0.5, 0.75};

// The eight samples around a place, and their weights.
struct Corners {
  std::array<std::size_t, 8> samples;
  alignas(64) std::array<double, 8> weights;
};

INLINE Corners cornersAround(const SampleGrid& grid, Vec3d p) {
  const Vec3d q = (1 / grid.cell) * (p - grid.origin);
  std::array<std::size_t, 3> number{};
  std::array<double, 3> part{};
  const std::array along{q.x, q.y, q.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = grid.counts[axis] - 1, within = std::clamp(along[axis], 0.0, last);
    number[axis] = static_cast<std::size_t>(std::min(within, last - 1));
    part[axis] = within - static_cast<double>(number[axis]);
  }
  Corners corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const std::size_t x = i & 1, y = i >> 1 & 1, z = i >> 2;
    corners.samples[i] = ((number[2] + z) * grid.counts[1] + number[1] + y) * grid.counts[0] + number[0] + x;
    corners.weights[i] =
        (x ? part[0] : 1 - part[0]) * (y ? part[1] : 1 - part[1]) * (z ? part[2] : 1 - part[2]);
  }
  return corners;
}

INLINE double valueAt(const Corners& corners, const float* samples) {
  double sum = 0;
  for (std::size_t i = 0; i < 8; ++i)
    sum += corners.weights[i] * static_cast<double>(samples[corners.samples[i]]);
  return sum;
}

INLINE Vec3d vectorAt(const Corners& corners, const float* samples) {
  Vec3d sum;
  for (std::size_t i = 0; i < 8; ++i) {
    const float* sample = samples + 3 * corners.samples[i];
    sum = sum + corners.weights[i] * Vec3f{sample[0], sample[1], sample[2]}.cast<double>();
  }
  return sum;
}

INLINE double squaresOf(const Corners& corners) {
  double sum = 0;
  for (const double weight : corners.weights) sum += weight * weight;
  return sum;
}

INLINE void lower(const Corners& corners, double by, float* samples) {
  for (std::size_t i = 0; i < 8; ++i) {
    float& sample = samples[corners.samples[i]];
    sample = canonical(static_cast<float>(static_cast<double>(sample) - by * corners.weights[i]));
  }
}

// visit(point) for points of all triangles, in one order, no farther apart than `spacing` [m].
template <class Visit>
INLINE void forEachPoint(const SolidMesh& mesh, double spacing, Visit visit) {
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    const Vec3d a = mesh.points[triangle[0]], b = mesh.points[triangle[1]] - a,
                c = mesh.points[triangle[2]] - a;
    const double longest = std::max({length(b), length(c), length(c - b)});
    const int count = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
    for (int i = 0; i <= count; ++i)
      for (int j = 0; i + j <= count; ++j)
        visit(a + (static_cast<double>(i) / count) * b + (static_cast<double>(j) / count) * c);
  }
}

// The smallest change that brings a point to 0 is along the weights. Distances are only ever lowered, so that
// what is enclosed once stays so.
INLINE void encloseOneShape(const SolidMesh& shape, const SampleGrid& grid, float* samples) {
  const double most = MOST_CELLS * grid.cell;
  for (int i = 0; i < FITS; ++i)
    forEachPoint(
        shape, grid.cell / FITTED_POINTS_A_CELL, [&](Vec3d p) __attribute__((always_inline)) {
          const Corners corners = cornersAround(grid, p);
          const double off = std::clamp(valueAt(corners, samples), -most, most);
          lower(corners, SHARE_OF_FIT * off / squaresOf(corners), samples);
        });
  forEachPoint(
      shape, grid.cell / POINTS_A_CELL, [&](Vec3d p) __attribute__((always_inline)) {
        const Corners corners = cornersAround(grid, p);
        const double above = std::min(valueAt(corners, samples), MOST_CELLS * grid.cell);
        if (above > 0) lower(corners, above / squaresOf(corners), samples);
      });
}

// As nearestOnMesh() in shaders/shared/shapes/mesh.h has it.
INLINE void encloseOneWay(const SolidMesh& from, const SolidMesh& to, const SampleGrid& grid,
                          float* fromSamples, float* toSamples, const SampleGrid& coarse,
                          const float* displacements) {
  for (const double part : partsOfWay) {
    const double rest = 1 - part;
    forEachPoint(
        between(from, to, part), grid.cell / POINTS_A_CELL, [&](Vec3d p) __attribute__((always_inline)) {
          const Vec3d way = vectorAt(cornersAround(coarse, p), displacements);
          const Corners before = cornersAround(grid, p - part * way),
                        after = cornersAround(grid, p + rest * way);
          const double above = std::min(
              rest * valueAt(before, fromSamples) + part * valueAt(after, toSamples), MOST_CELLS * grid.cell);
          if (above <= 0) return;
          const double share = above / (rest * rest * squaresOf(before) + part * part * squaresOf(after));
          lower(before, share * rest, fromSamples);
          lower(after, share * part, toSamples);
        });
  }
}

}  // namespace

VECTOR_CLONES(void, encloseShape, (const SolidMesh& shape, const SampleGrid& grid, float* samples),
              (shape, grid, samples), encloseOneShape(shape, grid, samples))
VECTOR_CLONES(void, encloseWay,
              (const SolidMesh& from, const SolidMesh& to, const SampleGrid& grid, float* fromSamples,
               float* toSamples, const SampleGrid& coarse, const float* displacements),
              (from, to, grid, fromSamples, toSamples, coarse, displacements),
              encloseOneWay(from, to, grid, fromSamples, toSamples, coarse, displacements))

}  // namespace clothsim
