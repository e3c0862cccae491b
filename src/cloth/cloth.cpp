#include "cloth/cloth.h"

#include <cmath>
#include <string>

#include "core/error.h"
#include "core/hash.h"
#include "scene/material.h"
#include "scene/pins.h"
#include "scene/pose.h"

namespace clothsim {
namespace {

constexpr std::uint64_t MAX_PARTICLES = 1ull << 26;
constexpr double NOMINAL_LENGTH_TOLERANCE = 1e-6;  // [m]
constexpr double JITTER = 0.001;                   // [m], z of a vertical sheet, so that it can buckle
constexpr std::uint32_t JITTER_SEED = 184;

double spacing(double length, int points) { return points > 1 ? length / (points - 1) : 0; }

double length(Vec3d a) { return std::sqrt(dot(a, a)); }

bool kindEnabled(const ClothSettings& settings, SpringKind kind) {
  switch (kind) {
    case SpringKind::structural:
      return settings.enableStructural;
    case SpringKind::shear:
      return settings.enableShearing;
    case SpringKind::bending:
      return settings.enableBending;
  }
  return false;
}

// Spring constants of the assignments' models (DESIGN.md section 4) [N/m].
double springStiffness(const ClothSettings& settings, SpringKind kind, double restLength) {
  if (settings.stiffnessReference)
    return *settings.stiffnessReference * settings.referenceLength / restLength;
  const double ks = settings.ks.value_or(0);
  return kind == SpringKind::bending ? 0.2 * ks : ks;
}

// The springs and masses of a material (scene/material.h).
void putMaterial(const ClothSettings& settings, Grid& grid) {
  const double dx = spacing(settings.width, grid.columns), dy = spacing(settings.height, grid.rows);
  const LatticeStiffness k = latticeStiffness(*settings.material, dx, dy);
  grid.hasMaterial = true;
  grid.particleMass = settings.material->density * dx * dy;
  grid.stiffness = {k.alongRow, k.alongColumn, k.diagonal, k.diagonal, 0, 0};
  grid.slotEnabled[toSecondLeft] = grid.slotEnabled[toSecondUpper] = false;
  if (!settings.enableBending) return;
  grid.bendAlongRow = k.bendAlongRow;
  grid.bendAlongColumn = k.bendAlongColumn;
}

Grid makeGrid(const ClothSettings& settings, std::uint32_t firstParticle) {
  Grid grid;
  grid.firstParticle = firstParticle;
  grid.columns = settings.numWidthPoints;
  grid.rows = settings.numHeightPoints;
  const double mass = settings.mass.value_or(settings.width * settings.height * settings.density);
  grid.particleMass = mass / grid.particleCount();
  const double dx = spacing(settings.width, grid.columns), dy = spacing(settings.height, grid.rows);
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
    const SpringOffset& offset = springOffsets[slot];
    const bool fits = std::abs(offset.columns) < grid.columns && std::abs(offset.rows) < grid.rows;
    if (!fits) continue;
    grid.slotEnabled[slot] = kindEnabled(settings, offset.kind);
    grid.nominalLength[slot] = std::hypot(offset.columns * dx, offset.rows * dy);
    grid.stiffness[slot] = springStiffness(settings, offset.kind, grid.nominalLength[slot]);
  }
  if (settings.material) putMaterial(settings, grid);
  return grid;
}

// Where the lattice begins: (u, 1, v) or (u, v, z) with z from a hash, turned and moved [m].
void appendPositions(const ClothSettings& settings, std::uint32_t firstParticle,
                     std::vector<Vec3d>& positions) {
  const Matrix3 turn = rotationMatrix(settings.rotation);
  const int columns = settings.numWidthPoints, rows = settings.numHeightPoints;
  const Vec3d origin = settings.orientation == Orientation::horizontal ? Vec3d{0, 1, 0} : Vec3d{0, 0, 0};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double u = columns > 1 ? settings.width * column / (columns - 1) : 0;
      const double v = rows > 1 ? settings.height * row / (rows - 1) : 0;
      const auto index = static_cast<std::uint32_t>(positions.size()) - firstParticle;
      const Vec3d local = settings.orientation == Orientation::horizontal
                              ? Vec3d{u, 0, v}
                              : Vec3d{u, v, JITTER * (2 * uniform01(JITTER_SEED, index) - 1)};
      positions.push_back(origin + rotate(turn, local) + settings.position);
    }
  }
}

// Whether some spring, measured between positions as binary32 stores them, differs from its kind's nominal
// length.
bool differsFromNominal(const Grid& grid, std::span<const Vec3d> positions) {
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
        const SpringOffset& offset = springOffsets[slot];
        if (!grid.slotEnabled[slot] || !grid.contains(column + offset.columns, row + offset.rows)) continue;
        const Vec3d a = positions[grid.particle(column, row)].cast<float>().cast<double>();
        const Vec3d b =
            positions[grid.particle(column + offset.columns, row + offset.rows)].cast<float>().cast<double>();
        if (std::abs(length(b - a) - grid.nominalLength[slot]) > NOMINAL_LENGTH_TOLERANCE) return true;
      }
    }
  }
  return false;
}

}  // namespace

Cloth::Cloth(const Scene& scene) {
  std::uint64_t total = 0;
  for (const ClothSettings& settings : scene.cloths)
    total += static_cast<std::uint64_t>(settings.numWidthPoints) *
             static_cast<std::uint64_t>(settings.numHeightPoints);
  if (total > MAX_PARTICLES)
    throw SceneError("the cloths hold " + std::to_string(total) + " particles together; at most " +
                     std::to_string(MAX_PARTICLES) +
                     " are possible. Use fewer points or a smaller --resolution.");
  positions_.reserve(total);
  inverseMasses_.reserve(total);
  for (const ClothSettings& settings : scene.cloths) {
    Grid grid = makeGrid(settings, particleCount());
    appendPositions(settings, grid.firstParticle, positions_);
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column)
        inverseMasses_.push_back(1 / (grid.particleMass * grid.massWeight(column, row)));
    for (const Pin& pin : settings.pinned) {
      const GridRange range = pointsOf(pin, settings);
      for (int row = range.from.row; row <= range.to.row; ++row)
        for (int column = range.from.column; column <= range.to.column; ++column)
          inverseMasses_[grid.particle(column, row)] = 0;
    }
    grid.hasRestLengthTable = differsFromNominal(grid, positions_);
    grids_.push_back(grid);
  }
}

std::size_t Cloth::gridOf(std::uint32_t particle) const {
  std::size_t grid = 0;
  while (particle - grids_[grid].firstParticle >= grids_[grid].particleCount()) ++grid;
  return grid;
}

bool Cloth::hasRestLengthTable() const {
  for (const Grid& grid : grids_)
    if (grid.hasRestLengthTable) return true;
  return false;
}

std::uint64_t Cloth::triangleCount() const {
  std::uint64_t count = 0;
  for (const Grid& grid : grids_)
    count += 2 * static_cast<std::uint64_t>(grid.columns - 1) * static_cast<std::uint64_t>(grid.rows - 1);
  return count;
}

std::uint64_t Cloth::springCount() const {
  std::uint64_t count = 0;
  for (const Grid& grid : grids_)
    for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
      if (grid.slotEnabled[slot])
        count += static_cast<std::uint64_t>(grid.columns - std::abs(springOffsets[slot].columns)) *
                 static_cast<std::uint64_t>(grid.rows - std::abs(springOffsets[slot].rows));
  return count;
}

std::vector<std::array<std::uint32_t, 3>> Cloth::triangles() const {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(triangleCount());
  for (const Grid& grid : grids_) {
    for (int row = 0; row + 1 < grid.rows; ++row) {
      for (int column = 0; column + 1 < grid.columns; ++column) {
        const std::uint32_t a = grid.particle(column, row), b = grid.particle(column + 1, row);
        const std::uint32_t c = grid.particle(column, row + 1), d = grid.particle(column + 1, row + 1);
        triangles.push_back({a, c, b});
        triangles.push_back({b, c, d});
      }
    }
  }
  return triangles;
}

std::vector<std::array<float, 2>> Cloth::textureCoordinates() const {
  std::vector<std::array<float, 2>> coordinates;
  coordinates.reserve(particleCount());
  for (const Grid& grid : grids_)
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column)
        coordinates.push_back({static_cast<float>(column) / static_cast<float>(std::max(1, grid.columns - 1)),
                               static_cast<float>(row) / static_cast<float>(std::max(1, grid.rows - 1))});
  return coordinates;
}

std::vector<Spring> Cloth::springs() const {
  std::vector<Spring> springs;
  for (const Grid& grid : grids_) {
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const std::uint32_t owner = grid.particle(column, row);
        for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
          const SpringOffset& offset = springOffsets[slot];
          if (!grid.slotEnabled[slot] || !grid.contains(column + offset.columns, row + offset.rows)) continue;
          const std::uint32_t other = grid.particle(column + offset.columns, row + offset.rows);
          const double measured = length(positions_[other] - positions_[owner]);
          springs.push_back(
              {static_cast<std::uint32_t>(SPRING_SLOTS) * owner + static_cast<std::uint32_t>(slot), owner,
               other, grid.stiffness[slot] * grid.springWeight(column, row, static_cast<SpringSlot>(slot)),
               grid.hasRestLengthTable ? measured : grid.nominalLength[slot]});
        }
      }
    }
  }
  return springs;
}

}  // namespace clothsim
