#include "scene/colliders/signed_distance_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <tuple>

#include "core/error.h"
#include "core/exact_math.h"
#include "core/recent.h"
#include "core/thread_team.h"

namespace clothsim {

namespace {

struct GridBox {
  Vec3d low;
  double cell;
  std::array<std::uint32_t, 3> counts;
};

GridBox boxAround(std::span<const SolidMesh> shapes, int cells) {
  Vec3d low = shapes.front().points.front(), high = low;
  for (const SolidMesh& shape : shapes)
    for (const Vec3d point : shape.points) {
      low = lowerCorner(low, point);
      high = upperCorner(high, point);
    }
  const Vec3d size = high - low;
  const double cell = std::max({size.x, size.y, size.z}) / cells;
  // Two cells more on each side: one that the mesh may not reach, and one against rounding.
  const auto count = [&](double side) { return static_cast<std::uint32_t>(std::ceil(side / cell)) + 5; };
  return {low, cell, {count(size.x), count(size.y), count(size.z)}};
}

using Counts = std::array<std::uint32_t, 3>;
std::size_t productOf(const Counts& counts) {
  return static_cast<std::size_t>(counts[0]) * counts[1] * counts[2];
}
// As shaders/shared/shapes/mesh.h has it.
Counts countsOfDisplacements(const Counts& counts) {
  return {counts[0] / 2 + 1, counts[1] / 2 + 1, counts[2] / 2 + 1};
}
std::size_t waysOf(std::size_t shapes, bool loops) { return shapes == 1 ? 0 : loops ? shapes : shapes - 1; }
std::size_t sampleCountOf(const Counts& counts, std::size_t shapes, bool loops) {
  return shapes * productOf(counts) + waysOf(shapes, loops) * 3 * productOf(countsOfDisplacements(counts));
}

using Numbers = std::array<std::size_t, 3>;  // of a point along x, y and z
std::size_t numberOf(const Numbers& at, const Counts& counts) {
  return (at[2] * counts[1] + at[1]) * counts[0] + at[0];
}

// Points of a grid side by side, eight but at the ends; the places behind the last repeat the first.
struct EightPoints {
  EightPlaces places{};
  std::array<Numbers, EightPlaces::EIGHT> at{};
  std::size_t count = 0;
};
EightPoints eightPointsFrom(const Numbers& first, const SampleGrid& grid) {
  EightPoints eight;
  for (std::size_t corner = 0; corner < EightPlaces::EIGHT; ++corner) {
    const Numbers at{first[0] + (corner & 1), first[1] + (corner >> 1 & 1), first[2] + (corner >> 2)};
    if (at[0] >= grid.counts[0] || at[1] >= grid.counts[1] || at[2] >= grid.counts[2]) continue;
    const Vec3d steps{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
    eight.places.set(eight.count, grid.origin + grid.cell * steps);
    eight.at[eight.count++] = at;
  }
  for (std::size_t k = eight.count; k < EightPlaces::EIGHT; ++k) eight.places.set(k, eight.places.at(0));
  return eight;
}
// sample(eight points) for all points of a grid, on all threads.
template <class Sample>
void forEachEight(const SampleGrid& grid, Sample sample) {
  ThreadTeam::shared().forEach(0, (grid.counts[2] + 1) / 2, 1, [&](std::uint32_t z) {
    for (std::size_t y = 0; y < grid.counts[1]; y += 2)
      for (std::size_t x = 0; x < grid.counts[0]; x += 2)
        sample(eightPointsFrom({x, y, std::size_t{2} * z}, grid));
  });
}

// What the coarse points around a fine one say of its distance [m].
struct RoughDistance {
  double low = 1e150, high = -1e150, mean = 0;
};
RoughDistance roughDistance(const Numbers& fine, const std::vector<double>& exact, const Counts& counts) {
  RoughDistance rough;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const double value = exact[numberOf(
        {(fine[0] + (corner & 1)) / 2, (fine[1] + (corner >> 1 & 1)) / 2, (fine[2] + (corner >> 2)) / 2},
        counts)];
    rough.low = std::min(rough.low, value);
    rough.high = std::max(rough.high, value);
    rough.mean += value / 8;
  }
  return rough;
}

}  // namespace

std::size_t SignedDistanceGrid::sampleCount(std::span<const SolidMesh> shapes, bool loops, int cells) {
  return sampleCountOf(boxAround(shapes, cells).counts, shapes.size(), loops);
}
std::size_t SignedDistanceGrid::samplesOfShape() const { return productOf(counts_); }
std::size_t SignedDistanceGrid::firstOfWay(std::size_t way) const {
  return firstOfShape(shapes_.size()) + way * 3 * productOf(countsOfDisplacements(counts_));
}

SignedDistanceGrid::SignedDistanceGrid(SolidMesh mesh, int cells)
    : SignedDistanceGrid(std::vector<SolidMesh>{std::move(mesh)}, false, cells) {}

SignedDistanceGrid::SignedDistanceGrid(std::vector<SolidMesh> shapes, bool loops, int cells)
    : shapes_(std::move(shapes)), last_(std::make_shared<const MeasuredMesh>(shapes_.front())) {
  const GridBox box = boxAround(shapes_, cells);
  cell_ = box.cell;
  counts_ = box.counts;
  origin_ = box.low - 2 * cell_ * Vec3d{1, 1, 1};
  samples_.resize(sampleCountOf(counts_, shapes_.size(), loops));
  if (shapes_.size() == 1) sampleDistances(shapes_[0], samples_.data());
  for (std::size_t i = 0; i < shapes_.size() && shapes_.size() > 1; ++i)
    sampleRoughly(shapes_[i], samples_.data() + firstOfShape(i));
  for (std::size_t i = 0; i < waysOf(shapes_.size(), loops); ++i)
    sampleDisplacements(shapes_[i], shapes_[(i + 1) % shapes_.size()], samples_.data() + firstOfWay(i));
  if (shapes_.size() > 1) enclose(waysOf(shapes_.size(), loops));
}

// A way lowers the distances of both its shapes: of three ways in a row the middle one waits for the others.
void SignedDistanceGrid::enclose(std::size_t ways) {
  const SampleGrid grid = this->grid(), coarse = gridOfDisplacements();
  ThreadTeam& team = ThreadTeam::shared();
  team.forEach(0, static_cast<std::uint32_t>(shapes_.size()), 1,
               [&](std::uint32_t i) { encloseShape(shapes_[i], grid, samples_.data() + firstOfShape(i)); });
  const auto encloseWayOf = [&](std::size_t i) {
    const std::size_t next = (i + 1) % shapes_.size();
    encloseWay(shapes_[i], shapes_[next], grid, samples_.data() + firstOfShape(i),
               samples_.data() + firstOfShape(next), coarse, samples_.data() + firstOfWay(i));
  };
  const std::size_t pairs = ways / 2;
  for (const std::uint32_t odd : {0u, 1u})
    team.forEach(0, static_cast<std::uint32_t>(pairs), 1,
                 [&](std::uint32_t i) { encloseWayOf(2 * i + odd); });
  if (ways % 2 == 1) encloseWayOf(ways - 1);
}

SampleGrid SignedDistanceGrid::grid() const { return {origin_, cell_, counts_}; }
SampleGrid SignedDistanceGrid::gridOfDisplacements() const {
  return {origin_, 2 * cell_, countsOfDisplacements(counts_)};
}

void SignedDistanceGrid::sampleDistances(const SolidMesh& shape, float* samples) const {
  const TriangleTree tree(shape);
  forEachEight(grid(), [&](const EightPoints& eight) {
    const EightPlaces::Numbers distances = tree.signedDistances(eight.places);
    for (std::size_t k = 0; k < eight.count; ++k)
      samples[numberOf(eight.at[k], counts_)] = canonical(static_cast<float>(distances[k]));
  });
}

// Of one of many shapes. Far from the surface every second point along x, y and z is exact, and those between
// are means: there distances only tell that nothing is near.
void SignedDistanceGrid::sampleRoughly(const SolidMesh& shape, float* samples) const {
  const double far = 3 * cell_;
  const TriangleTree tree(shape);
  const SampleGrid coarse = gridOfDisplacements();
  std::vector<double> exact(productOf(coarse.counts));
  forEachEight(coarse, [&](const EightPoints& eight) {
    const EightPlaces::Numbers distances = tree.signedDistances(eight.places);
    for (std::size_t k = 0; k < eight.count; ++k) exact[numberOf(eight.at[k], coarse.counts)] = distances[k];
  });
  forEachEight(grid(), [&](const EightPoints& eight) {
    std::array<RoughDistance, EightPlaces::EIGHT> rough;
    const auto willDo = [&](const RoughDistance& of) {
      return of.low > far || of.high < -far || of.low == of.high;
    };
    bool all = true;
    for (std::size_t k = 0; k < eight.count; ++k) {
      rough[k] = roughDistance(eight.at[k], exact, coarse.counts);
      all = all && willDo(rough[k]);
    }
    EightPlaces::Numbers distances{};
    if (!all) distances = tree.signedDistances(eight.places);
    for (std::size_t k = 0; k < eight.count; ++k)
      samples[numberOf(eight.at[k], counts_)] =
          canonical(static_cast<float>(willDo(rough[k]) ? rough[k].mean : distances[k]));
  });
}

// Where the way is half done, so that the nearest place is the one that is nearest in the mean.
void SignedDistanceGrid::sampleDisplacements(const SolidMesh& from, const SolidMesh& to,
                                             float* samples) const {
  const SolidMesh middle = between(from, to, 0.5);
  const TriangleTree tree(middle);
  const SampleGrid coarse = gridOfDisplacements();
  forEachEight(coarse, [&](const EightPoints& eight) {
    const std::array<MeshPoint, EightPlaces::EIGHT> nearest = tree.nearestPoints(eight.places);
    for (std::size_t k = 0; k < eight.count; ++k) {
      const Vec3f way = (placeOf(to, nearest[k]) - placeOf(from, nearest[k])).cast<float>();
      float* sample = samples + 3 * numberOf(eight.at[k], coarse.counts);
      sample[0] = canonical(way.x);
      sample[1] = canonical(way.y);
      sample[2] = canonical(way.z);
    }
  });
}

std::shared_ptr<const MeasuredMesh> SignedDistanceGrid::at(const ShapeMoment& moment) const {
  const std::lock_guard lock(mutex_);
  if (moment != lastMoment_) {
    last_ =
        std::make_shared<const MeasuredMesh>(between(shapes_[moment.from], shapes_[moment.to], moment.part));
    lastMoment_ = moment;
  }
  return last_;
}

double SignedDistanceGrid::distance(Vec3d p, const ShapeMoment& moment) const {
  return at(moment)->tree.signedDistance(p);
}

namespace {

using GridKey = std::tuple<std::string, double, int, int, int, bool>;
GridKey keyOf(const MeshCollider& collider) {
  return {collider.file,   collider.scale,      collider.cells,
          collider.shapes, collider.firstShape, collider.shapesLoop};
}

Recent<GridKey, SignedDistanceGrid>& knownGrids() {
  static Recent<GridKey, SignedDistanceGrid> grids(MOST_DISTANCE_SAMPLES);
  return grids;
}

[[noreturn]] void failForSamples(std::size_t place, std::size_t samples, std::size_t most) {
  throw SceneError("colliders." + std::to_string(place) +
                   ": with this one the meshes among the colliders need " + std::to_string(samples) +
                   " samples of distance, expected at most " + std::to_string(most) +
                   "; lower their `cells`, or use fewer of them");
}

// Between shapes that are far apart a grid could not tell which place of one becomes which of the other.
constexpr double MOST_CELLS_A_WAY = 16;

void checkDensity(const MeshCollider& collider, const std::vector<SolidMesh>& shapes) {
  const double cell = boxAround(shapes, collider.cells).cell;
  for (std::size_t way = 0; way < waysOf(shapes.size(), collider.shapesLoop); ++way) {
    const SolidMesh &from = shapes[way], &to = shapes[(way + 1) % shapes.size()];
    double farthest = 0;
    for (std::size_t i = 0; i < from.points.size(); ++i)
      farthest = std::max(farthest, length(to.points[i] - from.points[i]));
    if (farthest <= MOST_CELLS_A_WAY * cell) continue;
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  ": to the next shape a point goes %.3g m, expected at most %.0f cells of the grid, %.3g m; "
                  "use more shapes, or fewer `cells`",
                  farthest, MOST_CELLS_A_WAY, MOST_CELLS_A_WAY * cell);
    throw SceneError(collider.fileOf(static_cast<int>(way)) + text.data());
  }
}

std::shared_ptr<const SignedDistanceGrid> makeGrid(const MeshCollider& collider,
                                                   std::vector<SolidMesh> shapes) {
  checkDensity(collider, shapes);
  auto grid =
      std::make_shared<const SignedDistanceGrid>(std::move(shapes), collider.shapesLoop, collider.cells);
  knownGrids().add(keyOf(collider), grid, grid->samples().size());
  return grid;
}

}  // namespace

std::shared_ptr<const SignedDistanceGrid> distanceGridOf(const MeshCollider& collider) {
  if (auto grid = knownGrids().find(keyOf(collider))) return grid;
  return makeGrid(collider, loadShapes(collider));
}

DistanceGrids distanceGridsOf(std::span<const Collider> colliders, std::size_t most) {
  struct Wanted {
    std::shared_ptr<const SignedDistanceGrid> grid;  // null: to be made
    std::vector<SolidMesh> shapes;
    std::size_t samples = 0;
  };
  std::map<GridKey, Wanted> wanted;
  std::size_t samples = 0;
  for (std::size_t i = 0; i < colliders.size(); ++i)
    if (const auto* mesh = std::get_if<MeshCollider>(&colliders[i])) {
      const auto [place, isNew] = wanted.try_emplace(keyOf(*mesh));
      Wanted& own = place->second;
      if (isNew && (own.grid = knownGrids().find(keyOf(*mesh)))) {
        own.samples = own.grid->samples().size();
      } else if (isNew) {
        own.shapes = loadShapes(*mesh);
        own.samples = SignedDistanceGrid::sampleCount(own.shapes, mesh->shapesLoop, mesh->cells);
      }
      samples += own.samples;
      if (samples > most) failForSamples(i, samples, most);
    }
  DistanceGrids grids(colliders.size());
  for (std::size_t i = 0; i < colliders.size(); ++i)
    if (const auto* mesh = std::get_if<MeshCollider>(&colliders[i])) {
      Wanted& own = wanted[keyOf(*mesh)];
      if (!own.grid) own.grid = makeGrid(*mesh, std::move(own.shapes));
      grids[i] = own.grid;
    }
  return grids;
}

}  // namespace clothsim
