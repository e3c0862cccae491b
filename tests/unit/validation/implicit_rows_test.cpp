// Row on the implicit integrator's derivatives, and what its matrix has to be besides.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solver/cpu/coarse_elements.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/rows.h"
#include "support/elastic_energy.h"
#include "support/grabs.h"
#include "support/material_sheet.h"
#include "support/mesh_sheet.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

using Field = std::vector<Vec3d>;

// A sheet of 8 x 7 points with shear, bending, a clamp, which bending treats apart, and a strain limit of 10
// %, whose second springs begin at 8 %.
Scene limitedSheet() {
  Scene scene =
      test::materialSheet(8, 7, 1, 0.8, {.density = 0.2, .stretch = 3000, .shear = 700, .bend = 0.05});
  scene.cloths[0].pinned = {GridRange{{0, 0}, {1, 1}}, GridPoint{7, 6}};
  scene.solver.integrator = Integrator::implicit;
  scene.solver.strainLimit = 0.1;
  return scene;
}

Scene limitedMesh() {
  Scene scene = limitedSheet();
  ClothSettings& cloth = scene.cloths[0];
  cloth.mesh = test::meshFile(test::meshSheetText({.columns = 7, .rows = 8, .edge = 0.1, .disorder = 0.1}));
  cloth.pinned = {VertexPin{0}, VertexPin{20}};
  return scene;
}

class Sheet {
 public:
  explicit Sheet(const Scene& scene, const Cuts& cuts = {})
      : scene_(scene), cloth_(scene_), solver_(cloth_, scene_), cutMasks_(makeCutMasks(cloth_, cuts)) {
    solver_.setCuts(cuts);
    params_ = makeStepParams<double>(scene_, cloth_, 0, 0);
    restLengths_ = measureRestLengths<double>(cloth_);
    lists_ = makeMeshLists<double>(cloth_, cuts);
    const std::size_t count = cloth_.particleCount();
    stretches_ = cpu::makeMeshStretches<double>(cloth_, lists_);
    own_.resize(makeHierarchy<double>(cloth_, cuts), stretches_.membraneCount());
    forces_.resize(count);
    for (std::size_t i = 0; i < count; ++i) own_.diagonal[i] = 1 + static_cast<double>(i % 5);
  }

  [[nodiscard]] const Cloth& cloth() const { return cloth_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] Field random(double size, bool onlyFree) {
    std::uniform_real_distribution<double> uniform(-size, size);
    Field field(cloth_.particleCount());
    for (std::size_t i = 0; i < field.size(); ++i)
      if (!onlyFree || cloth_.inverseMasses()[i] > 0)
        field[i] = {uniform(engine_), uniform(engine_), uniform(engine_)};
    return field;
  }
  // Drawn out, or pushed together, by a factor, and disturbed.
  [[nodiscard]] Field deformed(double factor, double disorder) {
    Field x = random(disorder, false);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] + factor * cloth_.positions()[i];
    return x;
  }
  [[nodiscard]] Field forces(const Field& x) {
    for (std::uint32_t i = 0; i < x.size(); ++i) solver_.setPosition(i, x[i]);
    return solver_.forces();
  }
  void takeExactHessian() { own_.scalars.hessian = HESSIAN_EXACT; }
  // H p with the Hessian at x, projected if it is not asked otherwise.
  [[nodiscard]] Field product(const Field& x, const Field& p) {
    put(own_.iterate.positions, x);
    const cpu::PassArguments<double> pass = arguments();
    const int rows = cpu::rowsOf(cloth_.pieces()[0]);
    for (int row = 0; row < rows; ++row) cpu::linearize({pass, own_}, row);
    put(own_.directions.positions, p);
    cpu::ForceRows<double> forceRows;
    EXPECT_TRUE(forceRows.begin(cloth_.pieces()[0].isMesh ? 0 : cloth_.pieces()[0].columns));
    for (int row = 0; row < rows; ++row) cpu::multiply({pass, own_}, row, forceRows);
    Field result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      result[i] = {own_.products.x[i], own_.products.y[i], own_.products.z[i]};
    return result;
  }
  // Of the blocks of the first coarse level at x, against products with the motions of its aggregates: the
  // largest difference and the largest entry.
  [[nodiscard]] std::pair<double, double> errorOfFirstLevel(const Field& x) {
    (void)product(x, Field(x.size()));
    state_.positions = own_.iterate.positions;  // where the step starts
    const Hierarchy<double>& levels = own_.hierarchy;
    const LevelParams& level = levels.pieces[0][0];
    for (std::uint32_t c = 0; c < level.coarseCount; ++c)
      own_.centers[level.coarseFirst + c] = cpu::Four<double>{0.1 * c, 0.2, 0.3, 0};
    cpu::sumElements({arguments(), own_}, level, level.coarseFirst, level.coarseFirst + level.coarseCount);
    double error = 0, most = 0;
    for (std::uint32_t n = level.firstBlock; n < level.endBlock; ++n) {
      const auto& block = levels.blocks[n];
      if (block.column == ALL_VERTICES) continue;
      const auto& [tt, tr, rt, rr] = own_.coarseBlocks[n];
      for (std::size_t k = 0; k < 6; ++k) {
        const Field force = product(x, motionOf(block.column, k, x));
        for (std::size_t r = 0; r < 6; ++r) {
          const auto& columns = r < 3 ? (k < 3 ? tt : tr) : (k < 3 ? rt : rr);
          const Field motion = motionOf(block.row, r, x);
          double expected = 0;
          for (std::size_t i = 0; i < x.size(); ++i) expected += dot(motion[i], force[i]);
          error = std::max(error, std::abs(columns[k % 3][r % 3] - expected));
          most = std::max(most, std::abs(expected));
        }
      }
    }
    return {error, most};
  }
  // That of the exact Hessian, from differences of the forces.
  [[nodiscard]] Field productByDifferences(const Field& x, const Field& p, double step) {
    Field forwards = x, backwards = x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      forwards[i] = x[i] + step * p[i];
      backwards[i] = x[i] - step * p[i];
    }
    const Field after = forces(forwards), before = forces(backwards);
    Field result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      if (cloth_.inverseMasses()[i] > 0)
        result[i] = own_.diagonal[i] * p[i] - (0.5 / step) * (after[i] - before[i]);
    return result;
  }

 private:
  [[nodiscard]] cpu::PassArguments<double> arguments() {
    return {params_,
            nullptr,
            nullptr,
            nullptr,
            nullptr,
            pinStarts_,
            inverseMasses_.data(),
            restLengths_.data(),
            lists_,
            stretches_,
            interaction_,
            nullptr,
            false,
            cutMasks_.empty() ? nullptr : cutMasks_.data(),
            nullptr,
            state_,
            state_,
            forces_,
            watch_};
  }
  // How particles at x follow an aggregate that moves along, or from 3 on turns about, an axis.
  [[nodiscard]] Field motionOf(std::uint32_t aggregate, std::size_t k, const Field& x) const {
    const Hierarchy<double>& levels = own_.hierarchy;
    const auto& center = own_.centers[aggregate];
    const Vec3d axis{k % 3 == 0 ? 1.0 : 0.0, k % 3 == 1 ? 1.0 : 0.0, k % 3 == 2 ? 1.0 : 0.0};
    Field motion(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::uint32_t n = levels.prolongationStarts[i]; n < levels.prolongationStarts[i + 1]; ++n) {
        const auto& [vertex, weight] = levels.prolongation[n];
        if (vertex != aggregate || cloth_.inverseMasses()[i] == 0) continue;
        motion[i] = weight * (k < 3 ? axis : cross(axis, x[i] - Vec3d{center[0], center[1], center[2]}));
      }
    return motion;
  }
  static void put(Components<double>& c, const Field& field) {
    for (std::size_t i = 0; i < field.size(); ++i) {
      c.x[i] = field[i].x;
      c.y[i] = field[i].y;
      c.z[i] = field[i].z;
    }
  }

  Scene scene_;
  Cloth cloth_;
  CpuSolver<double> solver_;
  std::mt19937 engine_{5};
  StepParams<double> params_{};
  Components<double> pinStarts_, forces_;
  std::vector<double> inverseMasses_{cloth_.inverseMasses().begin(), cloth_.inverseMasses().end()};
  std::vector<double> restLengths_;
  MeshLists<double> lists_;
  cpu::MeshStretches<double> stretches_;
  InteractionParams<double> interaction_{};
  std::vector<std::uint32_t> cutMasks_;
  CpuState<double> state_;
  WatchRow watch_ = soundWatchRow();
  cpu::ImplicitState<double> own_;
};

double product(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}
double largest(const Field& field) {
  double most = 0;
  for (const Vec3d& v : field) most = std::max(most, std::sqrt(dot(v, v)));
  return most;
}
double relativeError(Field measured, const Field& expected) {
  for (std::size_t i = 0; i < measured.size(); ++i) measured[i] = measured[i] - expected[i];
  return largest(measured) / largest(expected);
}

// How much springs are stretched: the least and the most.
std::pair<double, double> strains(const Cloth& cloth, const Field& x) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const Spring& spring : cloth.springs()) {
    const Vec3d d = x[spring.b] - x[spring.a],
                rest = cloth.positions()[spring.b] - cloth.positions()[spring.a];
    const double strain = std::sqrt(dot(d, d) / dot(rest, rest)) - 1;
    least = std::min(least, strain);
    most = std::max(most, strain);
  }
  return {least, most};
}

const std::string derivativesRow = "implicit gradient and Hessian";

void expectGradient(const std::string& what, Sheet sheet, const Cuts& cuts) {
  const test::ElasticEnergy energy(sheet.scene(), sheet.cloth(), cuts);
  Field x = sheet.deformed(1.02, 0.02);
  constexpr double step = 1e-6;
  Field differences(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (double Vec3d::*axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      const double place = x[i].*axis;
      x[i].*axis = place + step;
      const double after = energy.at(x);
      x[i].*axis = place - step;
      const double before = energy.at(x);
      x[i].*axis = place;
      differences[i].*axis = -(after - before) / (2 * step);
    }
  expectAtMost({derivativesRow, "forces against differences of the energy, " + what, "double", ""},
               relativeError(sheet.forces(x), differences), 1e-6);
}

TEST(RowImplicitGradientAndHessian, ForcesAreTheGradientOfTheEnergy) {
  const Scene scene = limitedSheet();
  expectGradient("whole sheet", Sheet(scene), {});
  const Cuts cuts = test::someCuts(Cloth(scene));
  expectGradient("torn sheet", Sheet(scene, cuts), cuts);
}

// Where all springs pull, the projected Hessian is the exact one; some are beyond the beginning of the limit.
void expectHessian(const std::string& what, Sheet sheet, double disorder) {
  const Field x = sheet.deformed(1.07, disorder);
  const auto [least, most] = strains(sheet.cloth(), x);
  EXPECT_GT(least, 0.005);
  EXPECT_LT(least, 0.08);
  EXPECT_GT(most, 0.085);
  double error = 0;
  for (int k = 0; k < 5; ++k) {
    const Field p = sheet.random(1, true);
    error = std::max(error, relativeError(sheet.product(x, p), sheet.productByDifferences(x, p, 1e-6)));
  }
  expectAtMost({derivativesRow, "products against differences of the forces, " + what, "double", ""}, error,
               1e-5);
}

TEST(RowImplicitGradientAndHessian, ProductsAreDerivativesOfTheForces) {
  const Scene scene = limitedSheet();
  expectHessian("whole sheet", Sheet(scene), 0.002);
  expectHessian("torn sheet", Sheet(scene, test::someCuts(Cloth(scene))), 0.002);
  expectHessian("mesh", Sheet(limitedMesh()), 0.0015);
  expectHessian("torn mesh", Sheet(limitedMesh(), test::tornAcross(Cloth(limitedMesh()), 0.3)), 0.0015);
}

TEST(RowImplicitGradientAndHessian, ExactProductsAreSoWhereSpringsPush) {
  const Scene piece = limitedSheet(), mesh = limitedMesh();
  for (const auto& [scene, cuts] : {std::pair{piece, Cuts{}}, {mesh, Cuts{}}}) {
    Sheet sheet(scene, cuts);
    const Field x = sheet.deformed(0.8, 0.005);
    EXPECT_LT(strains(sheet.cloth(), x).second, -0.01);
    const Field p = sheet.random(1, true), expected = sheet.productByDifferences(x, p, 1e-6);
    const Field projected = sheet.product(x, p);
    sheet.takeExactHessian();
    expectAtMost({derivativesRow, "products where all springs push", "double", ""},
                 relativeError(sheet.product(x, p), expected), 1e-5);
    EXPECT_GT(relativeError(projected, expected), 0.01);
    EXPECT_GT(product(p, projected), product(p, expected));
  }
}

// Also where springs push: there the exact Hessian is not positive.
TEST(ImplicitMatrix, IsSymmetricAndPositiveOnCrumpledSheets) {
  const Scene piece = limitedSheet(), mesh = limitedMesh();
  for (const auto& [scene, cuts] : {std::pair{piece, Cuts{}},
                                    {piece, test::someCuts(Cloth(piece))},
                                    {mesh, Cuts{}},
                                    {mesh, test::tornAcross(Cloth(mesh), 0.3)}}) {
    Sheet sheet(scene, cuts);
    const Field x = sheet.deformed(0.7, 0.05);
    EXPECT_LT(strains(sheet.cloth(), x).first, -0.3);
    for (int k = 0; k < 20; ++k) {
      const Field p = sheet.random(1, true), q = sheet.random(1, true);
      const Field hp = sheet.product(x, p), hq = sheet.product(x, q);
      const double scale = std::sqrt(product(p, p) * product(hq, hq));
      EXPECT_NEAR(product(p, hq), product(q, hp), 1e-13 * scale);
      EXPECT_GE(product(p, hp), product(p, p)) << "anchors alone give as much";
      for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_TRUE(sheet.cloth().inverseMasses()[i] > 0 || hp[i] == Vec3d()) << "pins are no unknowns";
    }
  }
}

TEST(ImplicitMatrix, BetweenAggregatesIsThatOfTheFirstCoarseLevel) {
  const Scene grid = limitedSheet(), mesh = limitedMesh();
  for (const auto& [scene, cuts] :
       {std::pair{grid, Cuts{}}, {mesh, Cuts{}}, {mesh, test::tornAcross(Cloth(mesh), 0.3)}}) {
    Sheet sheet(scene, cuts);
    const auto [error, most] = sheet.errorOfFirstLevel(sheet.deformed(1.05, 0.03));
    EXPECT_LT(error, 1e-12 * most);
  }
}

}  // namespace
}  // namespace clothsim::validation
