// Cusick's drape test: a circular cloth held between two discs, whose rim hangs down in folds. The drape
// coefficient is the part of the rim's area that its shadow covers (ISO 9073-9; G. E. Cusick, 1965).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cloth/cuts.h"
#include "solver/cpu/cpu_solver.h"
#include "support/material_sheet.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

// A material and the sizes of the test, from which the same shape follows for the same B / (rho g l^3), l the
// overhang: as long as it is next to inextensible, and only then whatever its stretch.
struct Drape {
  double density = 0.15, bend = 4e-5, stretch = 100;  // [kg/m^2], [N m], [N/m]
  double discRadius = 0.09, clothRadius = 0.15;       // [m]

  [[nodiscard]] double overhang() const { return clothRadius - discRadius; }  // l
  // In which the rim would fall by half the overhang [s].
  [[nodiscard]] double fallTime() const { return std::sqrt(overhang() / GRAVITY); }
};

// The circle cut out of a square grid: every spring with an end outside of it is cut.
Cuts circleOf(const Cloth& cloth, const std::vector<double>& radii, double radius) {
  Cuts cuts(cloth.particleCount());
  const Piece& piece = cloth.pieces()[0];
  for (int row = 0; row < piece.rows; ++row)
    for (int column = 0; column < piece.columns; ++column)
      for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
        const int otherColumn = column + springOffsets[slot].columns,
                  otherRow = row + springOffsets[slot].rows;
        if (!piece.contains(otherColumn, otherRow)) continue;
        const std::uint32_t owner = piece.particle(column, row);
        if (radii[owner] > radius || radii[piece.particle(otherColumn, otherRow)] > radius)
          cuts[owner] = static_cast<std::uint8_t>(cuts[owner] | 1u << slot);
      }
  return cuts;
}

struct Flat {
  double x, y;
};

// The area that triangles cover together, counted in pixels.
class Shadow {
 public:
  Shadow(double halfSize, int pixels)
      : halfSize_(halfSize),
        pixels_(pixels),
        covered_(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels)) {}
  void add(Flat a, Flat b, Flat c) {
    const double area = cross(a, b, c);
    if (area == 0) return;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [low, high] = std::minmax({a.y, b.y, c.y});
    for (int j = pixel(low); j <= pixel(high); ++j)
      for (int i = pixel(left); i <= pixel(right); ++i) {
        const Flat p{center(i), center(j)};
        if (cross(a, b, p) / area >= 0 && cross(b, c, p) / area >= 0 && cross(c, a, p) / area >= 0)
          covered_[static_cast<std::size_t>(j) * static_cast<std::size_t>(pixels_) +
                   static_cast<std::size_t>(i)] = 1;
      }
  }
  [[nodiscard]] double area() const {
    double count = 0;
    for (const char covered : covered_) count += covered;
    return count * std::pow(2 * halfSize_ / pixels_, 2);
  }

 private:
  static double cross(Flat a, Flat b, Flat c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  [[nodiscard]] int pixel(double x) const {
    return std::clamp(static_cast<int>((x / halfSize_ + 1) / 2 * pixels_), 0, pixels_ - 1);
  }
  [[nodiscard]] double center(int i) const { return ((i + 0.5) / pixels_ * 2 - 1) * halfSize_; }

  double halfSize_;
  int pixels_;
  std::vector<char> covered_;
};

// The particles' distances from the middle of the cloth.
std::vector<double> radiiOf(const Cloth& cloth) {
  std::vector<double> radii;
  for (const Vec3d& x : cloth.positions()) radii.push_back(std::hypot(x.x, x.z));
  return radii;
}

// A square around the circular cloth, its middle at the origin. Held by the discs, and held out of the way
// outside of the circle. A particle stands for a cell around it: the clamp ends half a spacing inside of its
// last particles.
Scene drapeScene(const Drape& drape, int points) {
  const double side = 2 * drape.clothRadius, spacing = side / (points - 1);
  Scene scene = test::materialSheet(points, points, side, side,
                                    {.density = drape.density,
                                     .stretch = drape.stretch,
                                     .shear = 0.375 * drape.stretch,
                                     .bend = drape.bend,
                                     .damping = 0.5 / drape.fallTime()});
  scene.gravity = {0, -GRAVITY, 0};
  scene.cloths[0].position = {-drape.clothRadius, -1, -drape.clothRadius};
  const Cloth free(scene);
  const std::vector<double> radii = radiiOf(free);
  for (int row = 0; row < points; ++row)
    for (int column = 0; column < points; ++column) {
      const double radius = radii[free.pieces()[0].particle(column, row)];
      if (radius <= drape.discRadius + 0.5 * spacing || radius > drape.clothRadius)
        scene.cloths[0].pinned.emplace_back(GridPoint{column, row});
    }
  return scene;
}

// How many folds the rim falls into is an accident of the start: a wave of four, which the stiffer of these
// cloths would choose by themselves, of a fiftieth of the overhang.
Vec3d startOf(const Drape& drape, Vec3d x) {
  const double out = (std::hypot(x.x, x.z) - drape.discRadius) / drape.overhang();
  const double wave = 0.02 * drape.overhang() * out * out * std::cos(4 * std::atan2(x.z, x.x));
  return {x.x, x.y + wave, x.z};
}

// In percent. The area of the cloth is that of the triangles there are.
template <class Real>
double drapeCoefficient(const Drape& drape, int points) {
  const Scene scene = drapeScene(drape, points);
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  const Cuts cuts = circleOf(cloth, radiiOf(cloth), drape.clothRadius);
  solver.setCuts(cuts);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    if (cloth.inverseMasses()[i] > 0)
      solver.setPosition(i, startOf(drape, cloth.positions()[i]).cast<Real>());
  solver.step(static_cast<int>(24 * drape.fallTime() / stepLength(scene.solver)));

  const auto triangles = remainingTriangles(cloth, cuts);
  Shadow shadow(drape.clothRadius, 1200);
  const auto flat = [&](std::uint32_t i) {
    return Flat{static_cast<double>(solver.position(i).x), static_cast<double>(solver.position(i).z)};
  };
  for (const auto& [a, b, c] : triangles) shadow.add(flat(a), flat(b), flat(c));
  const double spacing = 2 * drape.clothRadius / (points - 1);
  const double disc = std::numbers::pi * drape.discRadius * drape.discRadius;
  const double whole = 0.5 * spacing * spacing * static_cast<double>(triangles.size());
  return 100 * (shadow.area() - disc) / (whole - disc);
}

const std::string drapeRow = "Cusick drape";

TEST(RowCusickDrape, LongDependsOnBendingOverWeightAlone) {
  const Drape cloth;
  const double middle = drapeCoefficient<float>(cloth, 61), fine = drapeCoefficient<float>(cloth, 91);
  expectNear({drapeRow, "drape coefficient at 91 x 91, expected that at 61 x 61", "binary32", "%"}, fine,
             middle, 2);
  expectNear({drapeRow, "drape coefficient at 121 x 121, expected that at 91 x 91", "binary32", "%"},
             drapeCoefficient<float>(cloth, 121), fine, 2);
  expectNear({drapeRow, "drape coefficient at 61 x 61, expected that in binary32", "double", "%"},
             drapeCoefficient<double>(cloth, 61), middle, 2);
  // Twice as heavy, half as large again, the stretch six times as large: B / (rho g l^3) is the same.
  const Drape other{.density = 2 * cloth.density,
                    .bend = 2 * 1.5 * 1.5 * 1.5 * cloth.bend,
                    .stretch = 6 * cloth.stretch,
                    .discRadius = 1.5 * cloth.discRadius,
                    .clothRadius = 1.5 * cloth.clothRadius};
  expectNear(
      {drapeRow, "drape coefficient of a larger, heavier cloth of the same B / (rho g l^3)", "binary32", "%"},
      drapeCoefficient<float>(other, 61), middle, 2);
  Drape softer = cloth, stiffer = cloth;
  softer.bend = 0.5 * cloth.bend;
  stiffer.bend = 2 * cloth.bend;
  expectAtMost({drapeRow, "drape coefficient with half the B, less that with B", "binary32", "%"},
               drapeCoefficient<float>(softer, 61) - middle, 0);
  expectAtMost({drapeRow, "drape coefficient with B, less that with twice the B", "binary32", "%"},
               middle - drapeCoefficient<float>(stiffer, 61), 0);
}

}  // namespace
}  // namespace clothsim::validation
