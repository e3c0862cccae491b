// Rows on a rope, a grid with one row of points: the hanging chain and the stretched string.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/cpu/cpu_solver.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

constexpr int LINKS = 32;

// A rope of `length` at rest along x through the origin, both ends pinned, whose springs have the constant
// EA / (rest length of a link); each of its particles has the mass of a link.
Scene ropeScene(double length, double mass, double stretchStiffness, double timeStep) {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.width = length;
  cloth.numWidthPoints = LINKS + 1;
  cloth.numHeightPoints = 1;
  cloth.position = {0, -1, 0};
  cloth.mass = mass / LINKS * (LINKS + 1);
  cloth.stiffnessReference = stretchStiffness;
  cloth.referenceLength = 1;
  cloth.enableBending = false;
  cloth.damping = 0;
  cloth.pinned = {GridPoint{0, 0}, GridPoint{LINKS, 0}};
  scene.solver.simulationSteps = 1;
  scene.solver.framesPerSec = 1 / timeStep;
  return scene;
}

constexpr double CHAIN_LENGTH = 1.5, CHAIN_MASS = 0.2, CHAIN_EA = 1000;

struct Span {
  double across, sag;
};
// Of the chain in balance: link i carries the horizontal pull H and the weight between it and the middle.
Span chainUnder(double pull) {
  Span span{0, 0};
  for (int i = 0; i < LINKS; ++i) {
    const double weight = CHAIN_MASS / LINKS * GRAVITY * ((LINKS - 1) / 2.0 - i);
    const double tension = std::hypot(pull, weight);
    const double length = CHAIN_LENGTH / LINKS * (1 + tension / CHAIN_EA);
    span.across += length * pull / tension;
    if (i < LINKS / 2) span.sag += length * weight / tension;
  }
  return span;
}

// Of the chain whose pins are 1 m apart, by bisection.
double discreteSag() {
  double low = 1e-3, high = 50;
  while (high - low > 1e-15 * high) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (chainUnder(middle).across < 1 ? low : high) = middle;
  }
  return chainUnder(low).sag;
}

template <class Real>
double settledSag() {
  constexpr double h = 2.5e-4;
  Scene scene = ropeScene(CHAIN_LENGTH, CHAIN_MASS, CHAIN_EA, h);
  scene.gravity = {0, -GRAVITY, 0};
  scene.cloths[0].damping = 0.25;  // 10 a second, so that no swing is left after 10 s
  scene.solver.integrator = Integrator::euler;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  for (std::uint32_t i = 0; i <= LINKS; ++i) {
    const double s = 2.0 * i / LINKS - 1;
    solver.setPosition(i, Vec3d{0.5 * s, -0.5 * (1 - s * s), 0}.cast<Real>());
  }
  solver.step(static_cast<int>(10 / h));
  return static_cast<double>(solver.position(0).y - solver.position(LINKS / 2).y);
}

TEST(RowHangingChain, SagsToTheRootOfTheDiscreteChain) {
  const double expected = discreteSag();
  EXPECT_NEAR(expected, 0.503586498, 1e-9) << "the root, worked out by an independent program";
  expectNear({"hanging chain", "sag of 32 links", "double", "m"}, settledSag<double>(), expected, 1e-9);
  expectNear({"hanging chain", "sag of 32 links", "binary32", "m"}, settledSag<float>(), expected, 1e-4);
}

// By crossings of rest of its middle, the string plucked in the shape of its first mode.
template <class Real>
double stringFrequency() {
  constexpr double h = 1e-4, tension = 5, massPerLength = 0.05;
  // Half as long at rest as between the pins, so EA = 2 T / 2.
  Scene scene = ropeScene(0.5, massPerLength, tension, h);
  scene.gravity = {0, 0, 0};
  scene.solver.integrator = Integrator::verlet;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  for (std::uint32_t i = 0; i <= LINKS; ++i)
    solver.setPosition(i, Vec3d{static_cast<double>(i) / LINKS,
                                i % LINKS == 0 ? 0 : 1e-3 * std::sin(std::numbers::pi * i / LINKS), 0}
                              .cast<Real>());
  constexpr int periods = 20;
  std::vector<double> crossings;
  double before = 1;
  for (int i = 1; crossings.size() < periods + 1; ++i) {
    solver.step(1);
    const auto now = static_cast<double>(solver.position(LINKS / 2).y);
    if (before > 0 && now <= 0) crossings.push_back(h * (i - now / (now - before)));
    before = now;
  }
  return periods / (crossings.back() - crossings.front());
}

TEST(RowStretchedString, SoundsAtTheFirstFrequencyOfTheDiscreteString) {
  const double massOfLink = 0.05 / LINKS;
  const double expected =
      std::sqrt(5 / (massOfLink / LINKS)) * std::sin(std::numbers::pi / (2 * LINKS)) / std::numbers::pi;
  EXPECT_NEAR(expected, 4.997992, 1e-6);
  expectNear({"stretched string", "first frequency", "double", "Hz"}, stringFrequency<double>(), expected,
             1e-4 * expected);
  expectNear({"stretched string", "first frequency", "binary32", "Hz"}, stringFrequency<float>(), expected,
             1e-4 * expected);
}

}  // namespace
}  // namespace clothsim::validation
