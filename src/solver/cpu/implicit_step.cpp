#include "solver/cpu/implicit_step.h"

#include "core/exact_math.h"
#include "solver/cpu/fixed_sum.h"

namespace clothsim::cpu {
namespace {

// A coarse level below this many vertices is not worth waking threads for.
constexpr std::uint32_t PARALLEL_VERTICES = 8192;

// Sums below this count as 0: their reciprocal would not be safe.
template <class Real>
constexpr Real leastSum = static_cast<Real>(0x1p-110f);

}  // namespace

template <class Real>
ImplicitStep<Real>::ImplicitStep(const Cloth& cloth, bool parallel)
    : cloth_(&cloth), parallel_(parallel), hierarchy_(makeHierarchy<Real>(cloth)) {
  const std::size_t particles = cloth.particleCount(), vertices = hierarchy_.vertices;
  for (Components<Real>* c : {&own_.anchors, &own_.ways, &own_.iterate.positions, &own_.directions.positions,
                              &own_.products, &own_.increments})
    c->resize(particles);
  own_.anchorStiffness.resize(particles);
  own_.air.resize(particles);
  for (std::vector<Real>& trial : own_.trials) trial.resize(particles);
  for (Components<Real>* c : {&own_.residuals, &own_.corrections}) c->resize(vertices);
  for (SymmetricField<Real>* field : {&own_.stretch, &own_.inertia, &own_.factors}) field->resize(vertices);
}

template <class Real>
template <class Pass>
void ImplicitStep<Real>::forEachLevelRow(std::uint32_t columns, std::uint32_t rows, Pass pass) {
#pragma omp parallel for schedule(static) if (columns * rows >= PARALLEL_VERTICES)
  for (std::uint32_t row = 0; row < rows; ++row) pass(static_cast<int>(row));
}

template <class Real>
template <class Pass>
void ImplicitStep<Real>::forEachRow(const std::vector<ImplicitArguments<Real>>& grids, Pass pass) {
  for (const ImplicitArguments<Real>& grid : grids) {
    const Grid& lattice = cloth_->grids()[grid.step.step.grid];
    const int rows = rowsOf(lattice);
#pragma omp parallel for schedule(static) if (parallel_ && isWorthThreads(lattice))
    for (int row = 0; row < rows; ++row) pass(grid, row);
  }
}

// Springs and bending alone: air is in the anchors.
template <class Real>
void ImplicitStep<Real>::gatherElasticForces(const std::vector<ImplicitArguments<Real>>& grids) {
  for (const ImplicitArguments<Real>& grid : grids) {
    StepParams<Real> elastic = grid.step.step;
    elastic.hasWind = 0;
    elastic.airResistance = 0;
    const PassArguments<Real> pass = withState(grid.step, elastic, own_.iterate, grid.step.forces);
    const Grid& lattice = cloth_->grids()[elastic.grid];
    const int rows = rowsOf(lattice);
#pragma omp parallel for schedule(static) if (parallel_ && isWorthThreads(lattice))
    for (int row = 0; row < rows; ++row) gatherForces(pass, row);
  }
}

template <class Real>
void ImplicitStep<Real>::coarsen() {
  for (const std::vector<LevelParams<Real>>& levels : hierarchy_.grids)
    for (const LevelParams<Real>& level : levels)
      forEachLevelRow(level.coarseColumns, level.coarseRows,
                      [&](int row) { coarsenBlocks(level, own_, row); });
}

template <class Real>
void ImplicitStep<Real>::precondition(const Real* inverseMasses) {
  for (std::size_t grid = 0; grid < hierarchy_.grids.size(); ++grid) {
    const std::vector<LevelParams<Real>>& levels = hierarchy_.grids[grid];
    for (const LevelParams<Real>& level : levels)
      forEachLevelRow(level.coarseColumns, level.coarseRows,
                      [&](int row) { restrictResiduals(level, own_, row); });
    const LevelParams<Real> coarsest =
        levels.empty() ? onlyLevel<Real>(cloth_->grids()[grid]) : levels.back();
    forEachLevelRow(coarsest.coarseColumns, coarsest.coarseRows,
                    [&](int row) { solveCoarsest(coarsest, own_, row); });
    for (std::size_t k = levels.size(); k-- > 0;)
      forEachLevelRow(levels[k].fineColumns, levels[k].fineRows,
                      [&](int row) { prolong(levels[k], own_, k == 0 ? inverseMasses : nullptr, row); });
  }
}

template <class Real>
Real ImplicitStep<Real>::product(const Components<Real>& a, const Components<Real>& b) {
  return fixedSum<Real>(cloth_->particleCount(), parallel_, partials_, [&](std::size_t i) {
    return dot(Vec3<Real>{a.x.data()[i], a.y.data()[i], a.z.data()[i]},
               Vec3<Real>{b.x.data()[i], b.y.data()[i], b.z.data()[i]});
  });
}

// Conjugate gradients. Where nothing is left, sums are 0 and nothing moves.
template <class Real>
void ImplicitStep<Real>::iterate(const std::vector<ImplicitArguments<Real>>& grids, int iterations) {
  ImplicitScalars<Real>& scalars = own_.scalars;
  const Real* inverseMasses = grids[0].step.inverseMasses;
  precondition(inverseMasses);
  scalars = {};
  scalars.residual = larger(product(own_.residuals, own_.corrections), Real(0));
  for (int k = 0; k < iterations; ++k) {
    forEachRow(grids, [](const auto& grid, int row) { direct(grid, row); });
    forEachRow(grids, [](const auto& grid, int row) { multiply(grid, row); });
    const Real curvature = product(own_.directions.positions, own_.products);
    scalars.stepSize = curvature > leastSum<Real> ? scalars.residual * reciprocal(curvature) : Real(0);
    scalars.promised = scalars.promised + scalars.stepSize * scalars.residual;
    forEachRow(grids, [](const auto& grid, int row) { advance(grid, row); });
    if (k + 1 == iterations) break;
    precondition(inverseMasses);
    const Real residual = larger(product(own_.residuals, own_.corrections), Real(0));
    scalars.kept = scalars.residual > leastSum<Real> ? residual * reciprocal(scalars.residual) : Real(0);
    scalars.residual = residual;
  }
}

// The longest of the lengths tried that lowers the energy enough, else the shortest.
template <class Real>
void ImplicitStep<Real>::searchLine(const std::vector<ImplicitArguments<Real>>& grids) {
  forEachRow(grids, [](const auto& grid, int row) { tryLengths(grid, row); });
  constexpr Real enough = static_cast<Real>(SUFFICIENT_DECREASE);
  Real length = 1;
  for (int k = 0; k < LENGTHS_TRIED; ++k) {
    const std::vector<Real>& trial = own_.trials[static_cast<std::size_t>(k)];
    const Real change =
        fixedSum<Real>(trial.size(), parallel_, partials_, [&](std::size_t i) { return trial.data()[i]; });
    if (change <= -((enough * length) * own_.scalars.promised) || k + 1 == LENGTHS_TRIED) break;
    length = Real(0.5) * length;
  }
  own_.scalars.newtonLength = length;
}

// What colliders the iterate is in.
template <class Real>
void ImplicitStep<Real>::findPlanes(const std::vector<ImplicitArguments<Real>>& grids) {
  if (grids[0].step.step.colliderCount == 0) return;
  own_.planes.resize(cloth_->particleCount());
  forEachRow(grids, [](const auto& grid, int row) {
    cpu::findPlanes(grid.step, grid.own.iterate.positions, grid.own.planes, row);
  });
}

// As much of the likely way as does not raise the energy.
template <class Real>
void ImplicitStep<Real>::takeStart(const std::vector<ImplicitArguments<Real>>& grids) {
  own_.scalars = {};
  searchLine(grids);
  forEachRow(grids, [](const auto& grid, int row) { accept(grid, row); });
}

template <class Real>
void ImplicitStep<Real>::run(const SolverSettings& settings, const ArgumentsOf& argumentsOf) {
  std::vector<ImplicitArguments<Real>>& grids = grids_;
  grids.clear();
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid)
    grids.push_back({argumentsOf(grid), own_});
  forEachRow(grids, [](const auto& grid, int row) { begin(grid, row); });
  findPlanes(grids);
  takeStart(grids);
  for (int k = 0; k < settings.newtonSteps; ++k) {
    findPlanes(grids);
    gatherElasticForces(grids);
    forEachRow(grids, [](const auto& grid, int row) { linearize(grid, row); });
    coarsen();
    iterate(grids, settings.cgIterations);
    searchLine(grids);
    forEachRow(grids, [](const auto& grid, int row) { accept(grid, row); });
  }
  forEachRow(grids, [](const auto& grid, int row) { end(grid, row); });
}

template class ImplicitStep<float>;
template class ImplicitStep<double>;

}  // namespace clothsim::cpu
