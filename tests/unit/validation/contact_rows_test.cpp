// Rows on contact: a cloth that lies on a sphere, a slope with friction, and the search for near particles.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <set>

#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/self_collision.h"
#include "solver/self_collision.h"
#include "support/lone_particle.h"
#include "support/point_clouds.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

using test::sheetScene;

// A small cloth that lies on top of a sphere: the impulse of the contacts in a step is the difference to the
// same step without the sphere.
template <class Real>
void expectWeightCarried() {
  constexpr double radius = 0.5, weight = 0.5 * 9.81;
  Scene scene = sheetScene(9);
  scene.cloths[0].ks = 200;
  scene.cloths[0].mass = 0.5;
  scene.cloths[0].width = scene.cloths[0].height = 0.3;
  scene.cloths[0].damping = 2;
  scene.cloths[0].position = {-0.15, radius - 1 + 1e-3, -0.15};
  scene.gravity = {0, -9.81, 0};
  scene.solver.integrator = Integrator::euler;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.colliders = {Sphere{.radius = radius, .friction = 0.5}};
  Scene without = scene;
  without.colliders.clear();
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene), free(cloth, without);
  solver.step(2700 * 4);
  double impulse = 0, deepest = 0;
  constexpr int steps = 270;
  for (int i = 0; i < steps; ++i) {
    for (std::uint32_t p = 0; p < cloth.particleCount(); ++p) {
      free.setPosition(p, solver.position(p));
      free.setVelocity(p, solver.velocity(p));
    }
    solver.step(1);
    free.step(1);
    for (std::uint32_t p = 0; p < cloth.particleCount(); ++p) {
      impulse += static_cast<double>(solver.velocity(p).y - free.velocity(p).y) / cloth.inverseMasses()[p];
      deepest = std::max(deepest, radius - length(solver.position(p).template cast<double>()));
    }
  }
  const std::string row = "sphere at rest under cloth";
  expectNear({row, "sum of contact impulses / dt", precisionOf<Real>, "N"},
             impulse / steps / stepLength(scene.solver), weight, 0.01 * weight);
  expectAtMost({row, "depth at particles over radius", precisionOf<Real>, ""}, deepest / radius, 1e-4);
}

TEST(RowSphereAtRestUnderCloth, CarriesItsWeight) {
  expectWeightCarried<double>();
  expectWeightCarried<float>();
}

// How far a particle slides down a slope of `degrees` with mu = 0.5: symplectic Euler, dt = 1/240.
template <class Real>
double slideOnSlope(double degrees, double seconds, bool box) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec3d normal{-std::sin(angle), std::cos(angle), 0};
  Collider slope = Plane{.point = {0.2, 0.1, 0}, .normal = normal, .friction = 0.5};
  if (box)
    slope = Box{.origin = Vec3d{0.2, 0.1, 0} - 0.5 * normal,
                .size = {9, 1, 1},
                .rotation = {0, 0, degrees},
                .friction = 0.5};
  Scene scene = test::particleScene(slope, 1.0 / 240, FrictionLaw::coulomb);
  scene.gravity = {0, -9.81, 0};
  const test::LoneParticle start{{0.2, 0.1, 0}, {0, 0, 0}};
  const test::LoneParticle end = test::afterSteps<Real>(scene, start, static_cast<int>(seconds * 240));
  EXPECT_LE(std::abs(dot(end.x - start.x, normal)), 2e-6);
  return -dot(end.x - start.x, Vec3d{std::cos(angle), std::sin(angle), 0});
}

template <class Real>
void expectSlides(bool box) {
  const std::string row = "slope with friction mu = .5", on = box ? " on a box" : " on a plane";
  const double critical = std::atan(0.5) * 180 / std::numbers::pi;
  // a dt^2 n (n + 1) / 2 with a = g (sin - mu cos), n = 480
  expectNear({row, "way in 2 s, 0.5 degrees above the critical angle," + on, precisionOf<Real>, "m"},
             slideOnSlope<Real>(critical + 0.5, 2, box), 0.191823, 0.01 * 0.191823);
  expectAtMost({row, "way in 10 s, 0.5 degrees below it," + on, precisionOf<Real>, "m"},
               std::abs(slideOnSlope<Real>(critical - 0.5, 10, box)), 1e-5);
}

TEST(RowSlopeWithFriction, SlidesAboveTheCriticalAngleAndSticksBelow) {
  for (const bool box : {false, true}) {
    expectSlides<double>(box);
    expectSlides<float>(box);
  }
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// Clouds of a sheet's particles and what the search finds in them. CS184's rule leaves no pair out.
template <class Real>
struct HashSearch {
  static constexpr std::size_t count = 144;
  Scene scene = test::contactScene(12, SelfCollision::averaged);
  Cloth cloth{scene};
  cpu::SelfCollision<Real> collision{cloth};
  double distance = contactDistance(scene, cloth);
  std::mt19937 random{1};
  Components<Real> points = test::cloud<Real>(count);
  int missed = 0, foundTwice = 0;

  HashSearch() { collision.configure(scene); }
  Real within(double low, double high) {
    return static_cast<Real>(std::uniform_real_distribution<double>(low, high)(random));
  }
  // All pairs within the contact distance, by looking at every pair, against those found.
  void compare() {
    const std::vector<Pair> found = collision.candidatePairs(points);
    const std::set<Pair> unique(found.begin(), found.end());
    foundTwice += static_cast<int>(found.size() - unique.size());
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = 0; j < count; ++j) {
        const Vec3d d = test::point(points, i) - test::point(points, j);
        if (i != j && dot(d, d) < distance * distance) missed += unique.count({i, j}) == 0;
      }
  }
  void compareIn(const std::function<Real()>& coordinate) {
    for (std::size_t k = 0; k < count; ++k) {
      points.x[k] = coordinate();
      points.y[k] = coordinate();
      points.z[k] = coordinate();
    }
    compare();
  }
  void expectNothingMissed(const std::string& clouds) const {
    expectAtMost({"hash candidates against brute force", "pairs missed in " + clouds, precisionOf<Real>, ""},
                 missed, 0);
    EXPECT_EQ(foundTwice, 0) << clouds;
  }
};

template <class Real>
void searchRandomClouds() {
  HashSearch<Real> search;
  for (int i = 0; i < 1000; ++i) {
    const double size = search.distance * std::pow(2.0, search.within(0, 6));
    const double corner[] = {search.within(-3, 3), search.within(-3, 3), search.within(-3, 3)};
    for (std::size_t k = 0; k < search.count; ++k) {
      search.points.x[k] = search.within(corner[0], corner[0] + size);
      search.points.y[k] = search.within(corner[1], corner[1] + size);
      search.points.z[k] = search.within(corner[2], corner[2] + size);
    }
    search.compare();
  }
  search.expectNothingMissed("1,000 random clouds");
}

// All in one cell; on borders of cells; negative; far from the origin; a bit beside borders of cells.
template <class Real>
void searchDegenerateClouds() {
  HashSearch<Real> search;
  const double cell = 1 / static_cast<double>(makeSelfParams<Real>(search.scene, search.cloth).inverseCell);
  for (int i = 0; i < 100; ++i) {
    const double far = std::pow(10.0, i / 5 % 5) * (i % 2 == 0 ? 1 : -1);
    search.compareIn([&]() -> Real {
      switch (i % 5) {
        case 0:
          return search.within(0.4 * cell, 0.6 * cell);
        case 1:
          return static_cast<Real>(cell * std::floor(search.within(-3, 3)));
        case 2:
          return search.within(-2 * cell, 0);
        case 3:
          return static_cast<Real>(far * 1.3 + static_cast<double>(search.within(0, 3 * cell)));
        default:
          return std::nextafter(static_cast<Real>(cell) * std::floor(search.within(-2, 2)),
                                search.within(-1, 1));
      }
    });
  }
  search.expectNothingMissed("100 degenerate clouds");
}

TEST(RowHashCandidates, AreASupersetOfThePairsInReach) {
  searchRandomClouds<float>();
  searchDegenerateClouds<float>();
  searchDegenerateClouds<double>();
}

TEST(RowHashCandidates, LongAreASupersetInDoubleToo) { searchRandomClouds<double>(); }

}  // namespace
}  // namespace clothsim::validation
