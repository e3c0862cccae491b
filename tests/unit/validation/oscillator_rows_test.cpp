// Rows on one mass on one spring: discrete phase, order of convergence, energy, and the pendulum.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "solver/cpu/cpu_solver.h"
#include "support/test_scenes.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

using test::springScene;

constexpr double MASS = 0.01, STIFFNESS = 40, STEP = 1e-3, AMPLITUDE = 0.25;
const double omega = std::sqrt(STIFFNESS / MASS);

constexpr std::pair<Integrator, const char*> integrators[] = {{Integrator::verlet, "verlet"},
                                                              {Integrator::euler, "symplectic euler"}};
constexpr std::pair<Integrator, const char*> implicitEuler{Integrator::implicit, "implicit euler"};
constexpr std::pair<Integrator, const char*> secondOrder{Integrator::bdf2, "bdf2"};

Scene swingScene(Integrator integrator, double step) {
  Scene scene = springScene(1, STIFFNESS, MASS, step, integrator);
  scene.solver.newtonSteps = 2;   // the spring stays straight,
  scene.solver.cgIterations = 3;  // and three numbers are unknown
  return scene;
}

// The mass starts a quarter of a metre below its place of rest, 1 m below the pin.
template <class Real>
struct Swing {
  Scene scene;
  Cloth cloth{scene};
  CpuSolver<Real> solver{cloth, scene};

  Swing(Integrator integrator, double step) : scene(swingScene(integrator, step)) {
    scene.solver.newtonSteps = 2;   // the spring stays straight,
    scene.solver.cgIterations = 3;  // and there are as many unknowns
    solver.setPosition(1, {0, static_cast<Real>(-1 - AMPLITUDE), 0});
  }
  [[nodiscard]] double stretch() const { return -1 - static_cast<double>(solver.position(1).y); }
};

// The angle a step of u(n) = A cos(n theta + phi), from u(n+1) + u(n-1) = 2 cos(theta) u(n) by least squares.
template <class Real>
double phasePerStep(Integrator integrator, int steps) {
  Swing<Real> swing(integrator, STEP);
  std::vector<double> u;
  for (int i = 0; i < steps; ++i, swing.solver.step(1)) u.push_back(swing.stretch());
  double products = 0, squares = 0;
  for (std::size_t i = 1; i + 1 < u.size(); ++i) {
    products += u[i] * (u[i + 1] + u[i - 1]);
    squares += u[i] * u[i];
  }
  return std::acos(products / (2 * squares));
}

template <class Real>
void expectPhase(double tolerance) {
  const double expected = 2 * std::asin(omega * STEP / 2);
  for (const auto& [integrator, name] : integrators)
    expectNear({"mass on a spring", std::string("phase a step, ") + name, precisionOf<Real>, "rad"},
               phasePerStep<Real>(integrator, 4000), expected, tolerance);
}

TEST(RowMassOnASpring, TurnsByTheDiscretePhaseInEveryStep) {
  expectPhase<double>(1e-10);
  expectPhase<float>(1e-5);
}

// The root z = r exp(i theta) of u(n+1) = 2 r cos(theta) u(n) - r^2 u(n-1), by least squares. Along its axis
// the spring is linear, so that one Newton step is exact; in binary32 a second one makes up for rounding.
template <class Real>
std::complex<double> implicitFactor(int steps) {
  Swing<Real> swing(Integrator::implicit, STEP);
  std::vector<double> u;
  for (int i = 0; i < steps; ++i, swing.solver.step(1)) u.push_back(swing.stretch());
  double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
  for (std::size_t i = 1; i + 1 < u.size(); ++i) {
    const double a = u[i], b = u[i - 1], c = u[i + 1];
    aa += a * a;
    ab += a * b;
    bb += b * b;
    ac += a * c;
    bc += b * c;
  }
  const double determinant = aa * bb - ab * ab;
  const double p = (ac * bb - bc * ab) / determinant, q = (aa * bc - ab * ac) / determinant;
  const double r = std::sqrt(-q);
  return std::polar(r, std::acos(p / (2 * r)));
}

template <class Real>
void expectImplicitFactor(int steps, double tolerance) {
  const double x = omega * STEP;
  const std::complex<double> factor = implicitFactor<Real>(steps);
  expectNear({"mass on a spring", "phase a step, implicit euler", precisionOf<Real>, "rad"}, std::arg(factor),
             std::atan(x), tolerance);
  expectNear({"mass on a spring", "amplitude over that before, implicit euler", precisionOf<Real>, ""},
             std::abs(factor), 1 / std::sqrt(1 + x * x), tolerance);
}

TEST(RowMassOnASpring, TurnsAndShrinksByTheDiscreteFactorUnderImplicitEuler) {
  expectImplicitFactor<double>(4000, 1e-10);
  expectImplicitFactor<float>(4000, 1e-5);
}

// Position error at t = 0.5 s against A cos(omega t).
template <class Real>
double swingError(Integrator integrator, double step) {
  Swing<Real> swing(integrator, step);
  swing.solver.step(static_cast<int>(std::lround(0.5 / step)));
  return std::abs(swing.stretch() - AMPLITUDE * std::cos(omega * 0.5));
}

// From two steps, the second half as long; short enough for the leading term of the error, and under binary32
// so long that it is far above rounding; that of bdf2 never is.
template <class Real>
void expectOrder(std::initializer_list<double> steps) {
  const double orders[] = {2, 1, 1, 2}, tolerances[] = {0.02, 0.05, 0.12, 0.05};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double step = steps.begin()[i];
    const auto& [integrator, name] = i < 2 ? integrators[i] : i == 2 ? implicitEuler : secondOrder;
    const double order =
        std::log2(swingError<Real>(integrator, step) / swingError<Real>(integrator, step / 2));
    expectNear({"order of convergence", name, precisionOf<Real>, ""}, order, orders[i], tolerances[i]);
  }
}

TEST(RowOrderOfConvergence, IsTwoForVerletAndBdf2AndOneForBothKindsOfEuler) {
  expectOrder<double>({1e-4, 1e-4, 1e-4, 1e-4});
  expectOrder<float>({5e-4, 1e-4, 1e-4});
}

struct EnergyErrors {
  double largest = 0, firstHalf = 0, secondHalf = 0;  // relative; the halves tell a trend
};

template <class Real>
EnergyErrors energyErrors(Integrator integrator) {
  constexpr int steps = 200000;
  Swing<Real> swing(integrator, STEP);
  const double start = 0.5 * STIFFNESS * AMPLITUDE * AMPLITUDE;
  EnergyErrors errors;
  for (int i = 1; i < steps; ++i) {
    swing.solver.step(1);
    const double u = swing.stretch();
    auto v = static_cast<double>(swing.solver.velocity(1).y);
    // Of the half step before under verlet: v(n) = v(n-1/2) + a h / 2.
    if (integrator == Integrator::verlet) v += 0.5 * STEP * STIFFNESS * u / MASS;
    const double error = std::abs((0.5 * MASS * v * v + 0.5 * STIFFNESS * u * u) / start - 1);
    errors.largest = std::max(errors.largest, error);
    double& half = i < steps / 2 ? errors.firstHalf : errors.secondHalf;
    half = std::max(half, error);
  }
  return errors;
}

// What rounding does to the energy: the mass's place, about 1 m from the origin, is rounded in every step by
// up to 2^-24 m, that is by 2.4e-7 of the amplitude, at random.
const std::string roundingWalks =
    "rounding of binary32 positions adds up at random to about 5e-5 of the energy in 2e5 steps, 5 % of the "
    "bound";

template <class Real>
void expectBoundedEnergy() {
  const double x = omega * STEP;
  const double bounds[] = {x * x / 4, (x / 2) / (1 - x / 2)};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& [integrator, name] = integrators[i];
    const EnergyErrors errors = energyErrors<Real>(integrator);
    const std::string row = "energy over 2e5 steps";
    const Figure largest{row, std::string("largest relative error, ") + name, precisionOf<Real>, ""},
        trend{row, std::string("second half less first half, ") + name, precisionOf<Real>, ""};
    const double demanded = 0.01 * bounds[i], change = errors.secondHalf - errors.firstHalf;
    if (std::is_same_v<Real, float> && integrator == Integrator::verlet) {
      reportUnmet(because(largest, roundingWalks), errors.largest, bounds[i], demanded, 0.1 * bounds[i]);
      reportUnmet(because(trend, roundingWalks), change, 0, demanded, 0.1 * bounds[i]);
    } else {
      expectNear(largest, errors.largest, bounds[i], demanded);
      expectNear(trend, change, 0, demanded);
    }
  }
}

TEST(RowEnergyOver200000Steps, StaysWithinItsBoundWithoutATrend) {
  expectBoundedEnergy<double>();
  expectBoundedEnergy<float>();
}

// Period from two crossings of the vertical in the same direction, interpolated. The rod is a spring so stiff
// that its stretch, g cos(angle) / stiffness at the start, changes the period by less than a tenth of what is
// demanded.
template <class Real>
double pendulumPeriod(double degrees) {
  constexpr double h = 1e-4, g = 9.81, stiffness = 1e6;
  Scene scene = springScene(1, stiffness, 1, h, Integrator::verlet);
  scene.gravity = {0, -g, 0};
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  const double angle = degrees * std::numbers::pi / 180;
  const double length = 1 + g * std::cos(angle) / stiffness;
  solver.setPosition(1, Vec3d{length * std::sin(angle), -length * std::cos(angle), 0}.cast<Real>());
  std::vector<double> crossings;
  auto before = static_cast<double>(solver.position(1).x);
  for (int i = 1; crossings.size() < 2; ++i) {
    solver.step(1);
    const auto now = static_cast<double>(solver.position(1).x);
    if (before > 0 && now <= 0) crossings.push_back(h * (i - now / (now - before)));
    before = now;
  }
  return crossings[1] - crossings[0];
}

template <class Real>
void expectPeriods() {
  // 4 sqrt(L/g) K(sin(angle / 2))
  for (const auto& [degrees, period] : {std::pair{10, 2.009892627}, {60, 2.152874667}, {90, 2.367841948}})
    expectNear({"pendulum", std::to_string(degrees) + " degrees", precisionOf<Real>, "s"},
               pendulumPeriod<Real>(degrees), period, 1e-4);
}

TEST(RowPendulum, SwingsWithThePeriodOfTheEllipticIntegral) {
  expectPeriods<double>();
  expectPeriods<float>();
}

}  // namespace
}  // namespace clothsim::validation
