#include "solver/gpu/implicit.h"

#include <algorithm>

namespace clothsim {
namespace {

constexpr std::size_t FACTOR_TEXELS = 2, BLOCK_TEXELS = 4, AIR_TEXELS = 2;

ParticleArray makeArray(const char* name, std::size_t texels) {
  checkFits(texels, sizeof(Particle4), name);
  return ParticleArray(name, texels);
}

}  // namespace

GpuImplicit::GpuImplicit(const Cloth& cloth, bool wind)
    : cloth_(&cloth), hierarchy_(makeHierarchy<float>(cloth)), hasAirBlocks_(wind) {
  std::vector<LevelSlot> slots;
  for (std::size_t grid = 0; grid < hierarchy_.grids.size(); ++grid) {
    firstSlots_.push_back(slots.size());
    for (const LevelParams<float>& level : hierarchy_.grids[grid]) slots.push_back({level});
    if (hierarchy_.grids[grid].empty()) slots.push_back({onlyLevel<float>(cloth.grids()[grid])});
  }
  levels_ = gl::Buffer<LevelSlot>("levels", std::span<const LevelSlot>(slots));

  const std::size_t particles = cloth.particleCount(), vertices = hierarchy_.vertices;
  residuals_ = makeArray("residuals", vertices);
  corrections_ = makeArray("corrections", vertices);
  factors_ = makeArray("factors", FACTOR_TEXELS * vertices);
  blocks_ = makeArray("blocks", BLOCK_TEXELS * vertices);
  anchors_ = makeArray("anchors", particles);
  airBlocks_ = makeArray("air blocks", wind ? AIR_TEXELS * particles : 1);
  ways_ = makeArray("ways", particles);
  iterates_ = makeArray("iterates", particles);
  directions_ = makeArray("directions", particles);
  products_ = makeArray("products", particles);
  increments_ = makeArray("increments", particles);
  partialSums_ = makeArray("partial sums", (particles + SUM_BLOCK - 1) / SUM_BLOCK);
  scalars_ = gl::Buffer<ImplicitScalars<float>>("implicit scalars", 1);
}

void GpuImplicit::choosePrograms(PassLibrary& library, const std::vector<PassFeatures>& grids) {
  gridPrograms_.clear();
  for (const PassFeatures& features : grids) {
    PassFeatures elastic = features;  // air is in the anchors
    elastic.wind = elastic.airResistance = elastic.jet = false;
    gridPrograms_.push_back(
        {library.find("implicit/begin", features), library.find("forces", elastic),
         library.find("implicit/linearize", features), library.find("implicit/multiply", features),
         library.find("implicit/try_lengths", features), library.find("implicit/end", features)});
  }
  const PassFeatures& any = grids[0];
  programs_ = {};
  programs_.coarsen = library.find("implicit/coarsen", any);
  programs_.restrict = library.find("implicit/restrict", any);
  programs_.prolong = library.find("implicit/prolong", any);
  programs_.solveCoarsest = library.find("implicit/solve_coarsest", any);
  programs_.direct = library.find("implicit/direct", any);
  programs_.advance = library.find("implicit/advance", any);
  programs_.accept = library.find("implicit/accept", any);
  for (const int kind : {SUM_FIRST, SUM_STEP, SUM_TURN, SUM_LENGTH}) {
    PassFeatures features = any;
    features.sumKind = kind;
    programs_.sumBlocks[kind] = library.find("implicit/sum_blocks", features);
    programs_.sumTotals[kind] = library.find("implicit/sum_totals", features);
  }
}

void GpuImplicit::setCutMasks(const std::vector<std::uint32_t>& cutMasks) {
  if (cutMasks.empty()) return;
  const std::vector<std::uint32_t> links = makeCutLinks(*cloth_, cutMasks, hierarchy_);
  if (cutLinks_.name() == 0) {
    cutLinks_ = gl::Buffer<std::uint32_t>("cut links", links.size());
    cutLinksTexture_ = gl::BufferTexture("cut links", cutLinks_.name(), GL_R32UI);
  }
  cutLinks_.upload(links);
}

void GpuImplicit::onGrids(const Run& run, const gl::Program* GridPrograms::*pass, const char* name) const {
  for (std::size_t i = 0; i < cloth_->grids().size(); ++i) {
    const Grid& grid = cloth_->grids()[i];
    run.bindGrid(i);
    run.runner.run(*(gridPrograms_[i].*pass), name, static_cast<std::uint32_t>(grid.columns),
                   static_cast<std::uint32_t>(grid.rows));
  }
}

void GpuImplicit::onParticles(const Run& run, const gl::Program& pass, const char* name) const {
  const std::uint32_t count = cloth_->particleCount();
  run.runner.run(pass, name, std::min(count, PARTICLES_A_ROW),
                 (count + PARTICLES_A_ROW - 1) / PARTICLES_A_ROW);
}

void GpuImplicit::onCoarse(const Run& run, const gl::Program& pass, const char* name,
                           std::size_t slot) const {
  levels_.bindUniformRange(LEVEL_PARAMS_BINDING, slot, 1);
  const std::size_t grid =
      static_cast<std::size_t>(std::upper_bound(firstSlots_.begin(), firstSlots_.end(), slot) -
                               firstSlots_.begin()) -
      1;
  const std::vector<LevelParams<float>>& levels = hierarchy_.grids[grid];
  const LevelParams<float> level =
      levels.empty() ? onlyLevel<float>(cloth_->grids()[grid]) : levels[slot - firstSlots_[grid]];
  run.runner.run(pass, name, level.coarseColumns, level.coarseRows);
}

// Residuals and the preconditioner at the iterate.
void GpuImplicit::linearize(const Run& run) const {
  iterates_.texture.bind(POSITIONS_UNIT);
  onGrids(run, &GridPrograms::forces, "implicit, forces");
  residuals_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
  factors_.buffer.bindStorage(SECOND_OUTPUT_BINDING);
  blocks_.buffer.bindStorage(THIRD_OUTPUT_BINDING);
  increments_.buffer.bindStorage(FOURTH_OUTPUT_BINDING);
  onGrids(run, &GridPrograms::linearize, "implicit, linearize");
  for (std::size_t grid = 0; grid < hierarchy_.grids.size(); ++grid)
    for (std::size_t k = 0; k < hierarchy_.grids[grid].size(); ++k)
      onCoarse(run, *programs_.coarsen, "implicit, coarsen", firstSlots_[grid] + k);
}

void GpuImplicit::precondition(const Run& run) const {
  constexpr const char* name = "implicit, precondition";
  for (std::size_t grid = 0; grid < hierarchy_.grids.size(); ++grid) {
    const std::vector<LevelParams<float>>& levels = hierarchy_.grids[grid];
    residuals_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
    for (std::size_t k = 0; k < levels.size(); ++k)
      onCoarse(run, *programs_.restrict, name, firstSlots_[grid] + k);
    corrections_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
    onCoarse(run, *programs_.solveCoarsest, name,
             firstSlots_[grid] + std::max<std::size_t>(levels.size(), 1) - 1);
    for (std::size_t k = levels.size(); k-- > 0;) {
      levels_.bindUniformRange(LEVEL_PARAMS_BINDING, firstSlots_[grid] + k, 1);
      run.runner.run(*programs_.prolong, name, levels[k].fineColumns, levels[k].fineRows);
    }
  }
}

void GpuImplicit::sum(const Run& run, int kind) const {
  partialSums_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
  run.runner.runGroups(*programs_.sumBlocks[kind], "implicit, sums",
                       static_cast<std::uint32_t>(partialSums_.buffer.size()));
  run.runner.runGroups(*programs_.sumTotals[kind], "implicit, sums", 1);
}

void GpuImplicit::iterate(const Run& run, int iterations) const {
  scalars_.bindStorage(SCALARS_BINDING);
  precondition(run);
  sum(run, SUM_FIRST);
  for (int k = 0; k < iterations; ++k) {
    directions_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
    onParticles(run, *programs_.direct, "implicit, vectors");
    products_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
    directions_.texture.bind(POSITIONS_UNIT);
    onGrids(run, &GridPrograms::multiply, "implicit, multiply");
    sum(run, SUM_STEP);
    residuals_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
    increments_.buffer.bindStorage(SECOND_OUTPUT_BINDING);
    onParticles(run, *programs_.advance, "implicit, vectors");
    if (k + 1 == iterations) break;
    precondition(run);
    sum(run, SUM_TURN);
  }
}

void GpuImplicit::searchLine(const Run& run) const {
  products_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
  onGrids(run, &GridPrograms::tryLengths, "implicit, line search");
  sum(run, SUM_LENGTH);
  ways_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
  iterates_.buffer.bindStorage(SECOND_OUTPUT_BINDING);
  onParticles(run, *programs_.accept, "implicit, vectors");
}

void GpuImplicit::run(PassRunner& runner, const SolverSettings& settings, const ParticleArray& positions,
                      const BindGrid& bindGrid) {
  const Run run{runner, bindGrid};
  residuals_.texture.bind(RESIDUALS_UNIT);
  corrections_.texture.bind(CORRECTIONS_UNIT);
  factors_.texture.bind(FACTORS_UNIT);
  blocks_.texture.bind(BLOCKS_UNIT);
  anchors_.texture.bind(ANCHORS_UNIT);
  airBlocks_.texture.bind(AIR_BLOCKS_UNIT);
  ways_.texture.bind(WAYS_UNIT);
  iterates_.texture.bind(ITERATES_UNIT);
  directions_.texture.bind(DIRECTIONS_UNIT);
  products_.texture.bind(PRODUCTS_UNIT);
  increments_.texture.bind(INCREMENTS_UNIT);
  partialSums_.texture.bind(PARTIAL_SUMS_UNIT);
  positions.texture.bind(STARTS_UNIT);
  if (cutLinks_.name() != 0) cutLinksTexture_.bind(CUT_LINKS_UNIT);

  anchors_.buffer.bindStorage(FIRST_OUTPUT_BINDING);
  ways_.buffer.bindStorage(SECOND_OUTPUT_BINDING);
  iterates_.buffer.bindStorage(THIRD_OUTPUT_BINDING);
  airBlocks_.buffer.bindStorage(FOURTH_OUTPUT_BINDING);
  onGrids(run, &GridPrograms::begin, "implicit, begin");
  for (int k = 0; k < settings.newtonSteps; ++k) {
    linearize(run);
    iterate(run, settings.cgIterations);
    searchLine(run);
  }
  positions.texture.bind(POSITIONS_UNIT);
  onGrids(run, &GridPrograms::end, "implicit, end");
}

}  // namespace clothsim
