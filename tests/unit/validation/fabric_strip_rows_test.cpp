// Strips of fabric with the settings that a user gets, their counts chosen by the program: pulled across
// their threads, standing and lying.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/direct_minimum.h"
#include "unit/validation/fabric_sheet.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

constexpr StepKind stripSteps[]{{Integrator::implicit, Orientation::horizontal},
                                {Integrator::implicit, Orientation::vertical},
                                {Integrator::bdf2, Orientation::horizontal},
                                {Integrator::bdf2, Orientation::vertical}};

void chooseAllCounts(Scene& scene) {
  scene.solver.simulationSteps = {1, true};
  chooseCounts(scene);
}

template <class Real>
void stepSeconds(CpuSolver<Real>& solver, const Scene& scene, double seconds) {
  solver.step(static_cast<int>(std::lround(seconds / stepLength(scene.solver))));
}

template <class Real>
std::vector<Vec3d> placesOf(const Cloth& cloth, const CpuSolver<Real>& solver) {
  std::vector<Vec3d> places;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    places.push_back(solver.position(i).template cast<double>());
  return places;
}

// A strip cut out of a square of 0.3 m along its diagonal, three times as long as wide, held by a 24th of its
// length at each end. Numbers of half diagonals of a cell count from the middle.
class BiasStrip {
 public:
  BiasStrip(const StepKind& kind, const std::string& fabric, int points)
      : half_((points - 1) / 2),
        scene(fabricSheet(kind, points, points, 0.3, 0.3, *materialPreset(fabric))),
        across_(normalOf(kind.orientation)) {
    const Cloth sheet(scene);
    const Piece& piece = sheet.pieces()[0];
    const std::vector<Vec3d> x(sheet.positions().begin(), sheet.positions().end());
    const Vec3d diagonal = x[piece.particle(points - 1, points - 1)] - x[piece.particle(0, 0)];
    along_ = (1 / length(diagonal)) * diagonal;
    for (int row = 0; row < points; ++row)
      for (int column = 0; column < points; ++column)
        if (!isFree(column, row)) scene.cloths[0].pinned.push_back(GridPoint{column, row});
    scene.gravity = GRAVITY * along_;
    chooseAllCounts(scene);
    cuts_.assign(sheet.particleCount(), 0);
    for (int row = 0; row < points; ++row)
      for (int column = 0; column < points; ++column)
        for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
          const SpringOffset& to = springOffsets[slot];
          if (!isInside(column, row) || !isInside(column + to.columns, row + to.rows))
            cuts_[piece.particle(column, row)] |= static_cast<std::uint8_t>(1u << slot);
        }
  }

  [[nodiscard]] const Cuts& cuts() const { return cuts_; }
  [[nodiscard]] Vec3d along() const { return along_; }
  [[nodiscard]] Vec3d normal() const { return across_; }
  // From clamp to clamp, and across [m].
  [[nodiscard]] double freeLength() const { return 2 * held() * 0.3 / (2 * half_) * std::numbers::sqrt2 / 2; }
  [[nodiscard]] double width() const { return half_ * 0.3 / (2 * half_) * std::numbers::sqrt2 / 2; }

  // Pulled by `pull` [m], evenly between the clamps.
  [[nodiscard]] std::vector<Vec3d> start(const Cloth& cloth, double pull) const {
    std::vector<Vec3d> places(cloth.positions().begin(), cloth.positions().end());
    const Piece& piece = cloth.pieces()[0];
    for (int row = 0; row < piece.rows; ++row)
      for (int column = 0; column < piece.columns; ++column) {
        const double part = std::clamp(0.5 + 0.5 * (column + row - 2 * half_) / held(), 0., 1.);
        Vec3d& place = places[piece.particle(column, row)];
        place = place + part * pull * along_;
      }
    return places;
  }
  [[nodiscard]] bool isInside(int column, int row) const {
    const int last = 2 * half_;
    if (column < 0 || row < 0 || column > last || row > last) return false;
    return 2 * std::abs(column + row - last) <= 3 * half_ && 2 * std::abs(column - row) <= half_;
  }
  [[nodiscard]] bool isFree(int column, int row) const {
    return isInside(column, row) && std::abs(column + row - 2 * half_) < held();
  }
  // The angle by which the threads in the middle have turned towards each other [degrees].
  [[nodiscard]] double shearAngle(const Cloth& cloth, const std::vector<Vec3d>& x) const {
    const Piece& piece = cloth.pieces()[0];
    const auto place = [&](int columns, int rows) {
      return x[piece.particle(half_ + columns, half_ + rows)];
    };
    const Vec3d a = place(2, 0) - place(-2, 0), b = place(0, 2) - place(0, -2);
    return std::asin(dot(a, b) / (length(a) * length(b))) * 180 / std::numbers::pi;
  }

 private:
  // The number of the clamps' inner ends.
  [[nodiscard]] double held() const { return 1.5 * half_ * 11 / 12; }

  int half_;

 public:
  Scene scene;

 private:
  Vec3d along_, across_;
  Cuts cuts_;
};

// Backward Euler damps the swing of the folds; `bdf2` leaves up to a tenth of the pull of it after 3 s,
// of silk on the finest grid 13 thousandths after 15 s, which is more than is asked.
double secondsToRest(Integrator integrator) { return integrator == Integrator::bdf2 ? 15 : 3; }

// Against the least energy that a direct solver finds from there on: in the plane if the strip has not left
// it, which it may do where it is pressed together. (The angle of a rhombus of threads that do not stretch,
// pi/2 - 2 acos((D + d) / (sqrt 2 D)) with D = length - width, is no known answer: the least energy of such
// threads shears the middle less, since what is outside of it shears as well.)
template <class Real>
void expectBiasExtension(const StepKind& kind, const std::string& fabric, int points) {
  const BiasStrip strip(kind, fabric, points);
  const Cloth cloth(strip.scene);
  const double pull = 0.1 * (strip.freeLength() - strip.width());
  const std::vector<Vec3d> start = strip.start(cloth, pull);
  CpuSolver<Real> solver(cloth, strip.scene);
  solver.setCuts(strip.cuts());
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) solver.setPosition(i, start[i].cast<Real>());
  stepSeconds(solver, strip.scene, secondsToRest(kind.integrator));
  const std::vector<Vec3d> places = placesOf(cloth, solver);

  const test::ElasticEnergy energy(strip.scene, cloth, strip.cuts());
  test::DirectMinimum minimum(energy, cloth);
  minimum.start = places;
  double outOfPlane = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    outOfPlane = std::max(outOfPlane, std::abs(dot(places[i] - start[i], strip.normal())));
  if (outOfPlane < 1e-9) minimum.normal = strip.normal();
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    if (cloth.inverseMasses()[i] > 0) minimum.loads[i] = (1 / cloth.inverseMasses()[i]) * strip.scene.gravity;
  const std::vector<Vec3d> expected = minimum.solve();

  double farthest = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    farthest = std::max(farthest, length(places[i] - expected[i]));
  const auto force = [&](const std::vector<Vec3d>& x) {
    const std::vector<Vec3d> gradient = energy.gradient(x);
    double sum = 0;
    for (int row = 0; row < points; ++row)
      for (int column = 0; column < points; ++column)
        if (!strip.isFree(column, row) && column + row > points - 1)
          sum += dot(gradient[cloth.pieces()[0].particle(column, row)], strip.along());
    return sum;
  };
  const auto figure = [&](const std::string& what, const std::string& unit) {
    return Figure{"bias extension",
                  what + ", " + fabric + ", " + std::to_string(points) + "^2, " + nameOf(kind),
                  precisionOf<Real>, unit};
  };
  const double asked = force(expected);
  expectAtMost(figure("farthest from the least energy over the pull", ""), farthest / pull, 0.01);
  expectNear(figure("force on a clamp", "N"), force(places), asked, 0.01 * asked);
  expectNear(figure("shear in the middle", "degrees"), strip.shearAngle(cloth, places),
             strip.shearAngle(cloth, expected), 0.1);
}

TEST(RowBiasExtension, ShearsAsTheLeastEnergyDoes) { expectBiasExtension<float>({}, "cotton", 17); }

// Folds form, whose energy hardly changes where they slide along. With projected Newton steps alone this one
// was still .13 of the pull away after 3 s.
TEST(RowBiasExtension, ComesToRestWhereItBuckles) {
  expectBiasExtension<float>({Integrator::implicit, Orientation::vertical}, "silk", 33);
}

TEST(RowBiasExtension, LongShearsAsTheLeastEnergyDoes) {
  for (const StepKind& kind : stripSteps)
    for (const std::string& fabric : threeFabrics())
      for (const int points : {33, 65, 129}) {
        expectBiasExtension<float>(kind, fabric, points);
        if (points < 129) expectBiasExtension<double>(kind, fabric, points);
      }
}

// How far a strip leans whose foot is clamped upright, as a part of its length: B theta'' = -rho g (L - s)
// sin theta, with theta = 0 at the foot and theta' = 0 at the tip, in the mode without a turning point. By
// Runge-Kutta steps from the tip, for the tip's angle with which the foot is upright.
double heavyElastica(double heightOverBucklingHeight) {
  if (heightOverBucklingHeight <= 1) return 0;
  const double load = 7.8373 * std::pow(heightOverBucklingHeight, 3);
  const auto fromTip = [&](double tip) {
    constexpr int parts = 4000;
    constexpr double h = 1. / parts;
    double angle = tip, rate = 0, lean = 0;
    for (int k = 0; k < parts; ++k) {  // s counts from the tip
      const double s = k * h;
      const double middle = angle + 0.5 * h * rate, rateThere = rate - 0.5 * h * load * s * std::sin(angle);
      lean += h * std::sin(middle);
      angle += h * rateThere;
      rate -= h * load * (s + 0.5 * h) * std::sin(middle);
    }
    return std::pair{angle, lean};
  };
  double low = 1e-6, high = 3.1;  // a small tip angle has turned past upright at the foot
  for (int k = 0; k < 60; ++k) {
    const double tip = 0.5 * (low + high);
    (fromTip(tip).first < 0 ? low : high) = tip;
  }
  return std::abs(fromTip(low).second);
}

template <class Real>
void expectStanding(Integrator integrator, const std::string& fabric, int cells, double part,
                    double seconds) {
  const StepKind kind{integrator, Orientation::vertical};
  const Material material = *materialPreset(fabric);
  const double height = part * bucklingHeight(material), h = height / cells;
  Scene scene = fabricSheet(kind, 3, cells + 2, 2 * h, h * (cells + 1), material);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 2; ++row) scene.cloths[0].pinned.push_back(GridPoint{column, row});
  chooseAllCounts(scene);
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  const Piece& piece = cloth.pieces()[0];
  for (int row = 2; row < cells + 2; ++row)  // bent a hundredth of its height to one side
    for (int column = 0; column < 3; ++column) {
      const std::uint32_t i = piece.particle(column, row);
      const double up = (row - 1) / static_cast<double>(cells);
      solver.setPosition(i, (cloth.positions()[i] + Vec3d{0, 0, 0.01 * height * up * up}).cast<Real>());
    }
  stepSeconds(solver, scene, seconds);
  double lean = 0;
  for (int column = 0; column < 3; ++column) {
    const std::uint32_t i = piece.particle(column, cells + 1);
    lean += (static_cast<double>(solver.position(i).z) - cloth.positions()[i].z) / (3 * height);
  }
  if (part > 1) lean = std::abs(lean);  // both sides are alike, and it may have swung through to the other
  expectNear(
      {"standing and lying strips",
       "lean of the tip over the height, " + std::to_string(part).substr(0, 3) + " of the buckling height, " +
           fabric + ", " + std::to_string(cells) + " cells, " + integratorName(integrator),
       precisionOf<Real>, ""},
      lean, heavyElastica(part), 0.005);
}

TEST(RowStandingStrip, LeansAsTheHeavyElasticaDoes) {
  for (const double part : {0.8, 1.3})
    expectStanding<float>(Integrator::implicit, "cotton", 16, part, part < 1 ? 1 : 10);
}

TEST(RowStandingStrip, LongLeansAsTheHeavyElasticaDoes) {
  for (const Integrator integrator : {Integrator::implicit, Integrator::bdf2})
    for (const std::string& fabric : materialPresetNames())
      for (const int cells : {32, 64, 128})
        for (const double part : {0.8, 0.9, 1.1, 1.3}) {
          expectStanding<float>(integrator, fabric, cells, part, 15);
          if (cells == 32) expectStanding<double>(integrator, fabric, cells, part, 15);
        }
}

template <class Real>
void expectLying(const StepKind& kind, const std::string& fabric, int points) {
  Scene scene = fabricSheet(kind, points, (points + 3) / 4, 0.4, 0.4 * ((points + 3) / 4 - 1) / (points - 1),
                            *materialPreset(fabric));
  const Vec3d normal = normalOf(kind.orientation);
  scene.gravity = -GRAVITY * normal;
  const Vec3d corner = Cloth(scene).positions()[0];
  scene.colliders = {Plane{.point = corner - 1e-3 * normal, .normal = normal, .friction = 0.5}};
  chooseAllCounts(scene);
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  stepSeconds(solver, scene, 1);  // it lands
  const std::vector<Vec3d> landed = placesOf(cloth, solver);
  stepSeconds(solver, scene, 5);
  const std::vector<Vec3d> places = placesOf(cloth, solver);
  double drift = 0, low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 0; i < places.size(); ++i) {
    drift = std::max(drift, length(places[i] - landed[i]));
    low = std::min(low, dot(places[i], normal));
    high = std::max(high, dot(places[i], normal));
  }
  const auto figure = [&](const std::string& what) {
    return Figure{"standing and lying strips",
                  what + ", lying, " + fabric + ", " + std::to_string(points) + " points, " + nameOf(kind),
                  precisionOf<Real>, "m"};
  };
  expectAtMost(figure("drift in 5 s"), drift, 1e-6);
  expectAtMost(figure("highest less lowest"), high - low, 1e-6);
}

TEST(RowLyingStrip, StaysFlatWhereItLies) { expectLying<float>({}, "silk", 17); }

TEST(RowLyingStrip, LongStaysFlatWhereItLies) {
  for (const StepKind& kind : stripSteps)
    for (const std::string& fabric : materialPresetNames())
      for (const int points : {33, 65, 129}) {
        expectLying<float>(kind, fabric, points);
        if (points == 33) expectLying<double>(kind, fabric, points);
      }
}

}  // namespace
}  // namespace clothsim::validation
