// Fabrics in implicit steps of 1/60 s with the settings that a user gets: how they stand, drape, hang and
// fall over.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "unit/validation/fabric_sheet.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

constexpr StepKind bothIntegrators[]{{Integrator::implicit}, {Integrator::bdf2}};

// By the last rows' own weight: rho g L^2 / 2 Y, where Poisson's effect makes little of it.
template <class Real>
void expectSag(StepKind kind, const std::string& fabric, int points) {
  kind.orientation = Orientation::vertical;
  const Material material = *materialPreset(fabric);
  Scene scene = fabricSheet(kind, points, points, 1, 1, material);
  scene.cloths[0].pinned = {GridSide::top};
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(2 * 60);
  double sag = 0;
  for (int column = 0; column < points; ++column) {
    const std::uint32_t i = cloth.pieces()[0].particle(column, 0);
    sag += (cloth.positions()[i].y - static_cast<double>(solver.position(i).y)) / points;
  }
  const double expected = material.density * GRAVITY / (2 * material.stretch);
  expectNear({"standing fabric",
              "sag of the lower edge, " + fabric + ", " + std::to_string(points) + "^2, " +
                  nameOf({kind.integrator}),
              precisionOf<Real>, "m"},
             sag, expected, 0.05 * expected);
}

TEST(RowFabricStanding, SagsByItsWeight) { expectSag<float>({}, "denim", 33); }

TEST(RowFabricStanding, LongSagsByItsWeight) {
  for (const StepKind& kind : bothIntegrators)
    for (const std::string& fabric : materialPresetNames())
      for (const int points : {33, 65, 129}) expectSag<double>(kind, fabric, points);
}

// How much of the rim of a square of 30 cm on a disc of 18 cm is above its shadow [%]. It swings for some 6
// s.
template <class Real>
double squareDrape(const StepKind& kind, const std::string& fabric, int points, int effort, double seconds) {
  constexpr double width = 0.3, radius = 0.09, cell = 0.001;
  Scene scene = fabricSheet(kind, points, points, width, width, *materialPreset(fabric));
  const double h = width / (points - 1);
  for (int row = 0; row < points; ++row)
    for (int column = 0; column < points; ++column)
      if (std::hypot(column * h - width / 2, row * h - width / 2) <= radius + 1e-9)
        scene.cloths[0].pinned.push_back(GridPoint{column, row});
  if (effort > 1) {
    scene.solver.cgIterations = scene.solver.cgIterations.count * effort;
    scene.solver.newtonSteps *= effort;
  }
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(static_cast<int>(seconds * 60));
  const Piece& piece = cloth.pieces()[0];
  const Vec3d middle =
      Vec3d{width / 2, 0, width / 2} + cloth.positions()[piece.particle(0, 0)].cast<double>();
  const auto at = [&](int column, int row) {
    return solver.position(piece.particle(column, row)).template cast<double>() - middle;
  };
  constexpr int across = 400, samples = 24;
  std::vector<char> shadow(static_cast<std::size_t>(across) * across);
  for (int row = 0; row + 1 < points; ++row)
    for (int column = 0; column + 1 < points; ++column)
      for (int a = 0; a < samples; ++a)
        for (int b = 0; b < samples; ++b) {
          const double u = (a + 0.5) / samples, w = (b + 0.5) / samples;
          const Vec3d x = (1 - w) * ((1 - u) * at(column, row) + u * at(column + 1, row)) +
                          w * ((1 - u) * at(column, row + 1) + u * at(column + 1, row + 1));
          const int i = static_cast<int>(std::floor(x.x / cell)) + across / 2,
                    j = static_cast<int>(std::floor(x.z / cell)) + across / 2;
          if (i >= 0 && j >= 0 && i < across && j < across)
            shadow[static_cast<std::size_t>(i) * across + static_cast<std::size_t>(j)] = 1;
        }
  double area = 0;
  for (const char covered : shadow) area += covered * cell * cell;
  const double disc = std::numbers::pi * radius * radius;
  return 100 * (area - disc) / (width * width - disc);
}

TEST(RowFabricDrape, LongIsStifferTheStifferTheFabric) {
  for (const StepKind& kind : bothIntegrators) {
    std::vector<double> drapes;
    for (const std::string fabric : {"silk", "denim"}) {
      drapes.push_back(squareDrape<float>(kind, fabric, 41, 1, 8));
      const auto figure = [&](const std::string& what) {
        return Figure{"drape at defaults", fabric + ", square of 30 cm, " + what + ", " + nameOf(kind),
                      "binary32", "%"};
      };
      expectNear(figure("41^2 against 81^2"), drapes.back(), squareDrape<float>(kind, fabric, 81, 1, 8), 2);
      expectNear(figure("41^2 against ten times the iterations"), drapes.back(),
                 squareDrape<float>(kind, fabric, 41, 10, 8), 2);
    }
    expectAtMost({"drape at defaults", "silk less denim, 41^2, " + nameOf(kind), "binary32", "%"},
                 drapes[0] - drapes[1], -5);
  }
}

// How far a chain of 1.5 m between pins 1 m apart, that began as a parabola, lies from the discrete catenary
// of its links.
template <class Real>
double chainError(const StepKind& kind, int links) {
  constexpr double length = 1.5, mass = 0.2, stiffness = 1000;  // [m], [kg], EA [N]
  Scene scene = fabricSheet(kind, links + 1, 1, length, 0, Material{});
  ClothSettings& cloth = scene.cloths[0];
  cloth.material.reset();
  cloth.mass = mass / links * (links + 1);
  cloth.stiffnessReference = stiffness;
  cloth.referenceLength = 1;
  cloth.enableBending = false;
  cloth.damping = 0.1;
  cloth.pinned = {GridPoint{0, 0}, GridPoint{links, 0}};
  scene.solver.strainLimit.reset();
  scene.solver.selfCollision = SelfCollision::off;
  const Cloth chain(scene);
  CpuSolver<Real> solver(chain, scene);
  for (int i = 0; i <= links; ++i) {
    const double s = 2.0 * i / links - 1;
    solver.setPosition(static_cast<std::uint32_t>(i), Vec3d{0.5 * s, -0.5 * (1 - s * s), 0}.cast<Real>());
  }
  solver.step(15 * 60);
  // Link by link from the left, for the tension at the pin that ends at the right one.
  const double weight = mass * GRAVITY / links, rest = length / links;
  const auto profile = [&](double pull) {
    std::vector<Vec3d> places{{-0.5, 0, 0}};
    for (int i = 0; i < links; ++i) {
      const double lift = weight * (0.5 * links - 0.5 - i), tension = std::hypot(pull, lift);
      const double stretched = rest + tension / (stiffness / rest);
      places.push_back(places.back() + stretched / tension * Vec3d{pull, -lift, 0});
    }
    return places;
  };
  double low = 1e-3, high = 50;
  for (int k = 0; k < 200; ++k)
    (profile(0.5 * (low + high)).back().x < 0.5 ? low : high) = 0.5 * (low + high);
  const std::vector<Vec3d> places = profile(low);
  double error = 0;
  for (int i = 0; i <= links; ++i) {
    const Vec3d off = solver.position(static_cast<std::uint32_t>(i)).template cast<double>() -
                      places[static_cast<std::size_t>(i)];
    error = std::max(error, std::sqrt(dot(off, off)));
  }
  return error;
}

void expectCatenary(const StepKind& kind, int links) {
  expectAtMost(
      {"chain at defaults",
       "farthest from the discrete catenary after 15 s, " + std::to_string(links) + " links, " + nameOf(kind),
       "binary32", "m"},
      chainError<float>(kind, links), 1e-3);
}

TEST(RowChainAtDefaults, HangsInTheCatenary) { expectCatenary({}, 128); }

TEST(RowChainAtDefaults, LongHangsInTheCatenary) {
  for (const StepKind& kind : bothIntegrators)
    for (const int links : {32, 64, 128, 256}) expectCatenary(kind, links);
}

// A stiff board on a hinge below, 10 degrees from upright, falls as a rod does: theta'' = 3 g / 2 L sin
// theta.
TEST(RowTopplingBoard, FallsAsARodDoes) {
  const Material board{.density = 0.2, .stretch = 5000, .shear = 2000, .bend = 1, .damping = 0};
  Scene scene = fabricSheet({Integrator::bdf2, Orientation::vertical}, 5, 33, 0.1, 1, board);
  scene.cloths[0].pinned = {GridSide::bottom};
  const double lean = 10 * std::numbers::pi / 180;
  scene.gravity = {0, -GRAVITY * std::cos(lean), GRAVITY * std::sin(lean)};
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  constexpr int steps = 36;
  solver.step(steps);
  const Piece& piece = cloth.pieces()[0];
  const Vec3d way = solver.position(piece.particle(2, 0)).cast<double>() -
                    solver.position(piece.particle(2, 32)).cast<double>();
  const double turned = std::atan2(std::abs(way.z), std::abs(way.y)) * 180 / std::numbers::pi;
  double theta = lean, rate = 0;
  for (int k = 0; k < steps * 1000; ++k) {
    rate += 1.5 * GRAVITY * std::sin(theta) / 60'000;
    theta += rate / 60'000;
  }
  expectNear({"toppling board", "turned in 0.6 s, bdf2", "binary32", "degrees"}, turned,
             (theta - lean) * 180 / std::numbers::pi, 1);
}

}  // namespace
}  // namespace clothsim::validation
