// From level to level of the implicit integrator's preconditioner; the twin of
// shaders/sim/implicit/{find_centers,coarsen,invert_dense}.comp and {restriction,dense,prolongation}.glsl.
#include "solver/cpu/multilevel.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/thread_team.h"
#include "solver/cpu/coarse_elements.h"
#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/piece_ranges.h"
#include "solver/cpu/rigid_block.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

// How many vertices of a level a thread takes at once, and how many of their rows of the matrix, each of
// which takes some 50 us to sum up.
constexpr std::uint32_t VERTICES_AT_ONCE = 64, ROWS_AT_ONCE = 4;
// Rows of the first level's matrix that a thread sums up together. Elements where two such stretches meet are
// worked out for both: of a cloth of 128 x 128, in stretches of 128 rows, almost half of them.
constexpr std::uint32_t LEAST_FIRST_ROWS = 128;
std::uint32_t firstRowsAtOnce(std::uint32_t rows) {
  const auto threads = static_cast<std::uint32_t>(ThreadTeam::shared().threads());
  return threads == 1 ? std::max(rows, 1u) : std::max(LEAST_FIRST_ROWS, rows / (2 * threads) + 1);
}

// Where a vertex is: a particle, or the center of an aggregate.
template <class Real>
INLINE Four<Real> placeOf(const ImplicitState<Real>& own, const Arrays<const Real>& x, std::uint32_t vertex) {
  return vertex < own.hierarchy.particles ? fourAt(x, static_cast<std::ptrdiff_t>(vertex))
                                          : own.centers.data()[vertex - own.hierarchy.particles];
}

template <class Real>
INLINE Real weightOf(const ImplicitState<Real>& own, std::uint32_t fine, std::uint32_t coarse) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const std::uint32_t vertex = hierarchy.particles + fine;
  for (std::uint32_t n = hierarchy.prolongationStarts[vertex]; n < hierarchy.prolongationStarts[vertex + 1];
       ++n)
    if (hierarchy.prolongation[n].vertex == coarse) return hierarchy.prolongation[n].weight;
  return 0;
}

}  // namespace

template <class Real>
void findCenter(ImplicitState<Real>& own, std::uint32_t coarse) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const Arrays<const Real> x = arraysOf(std::as_const(own.iterate.positions));
  Four<Real> sum{};
  Real weights = 0;
  for (std::uint32_t n = hierarchy.restrictionStarts[coarse]; n < hierarchy.restrictionStarts[coarse + 1];
       ++n) {
    const auto& [vertex, weight] = hierarchy.restriction[n];
    sum = sum + weight * placeOf(own, x, vertex);
    weights = weights + weight;
  }
  own.centers[coarse] = canonicalOf(reciprocal(weights) * sum);
}

namespace {

template <class Real>
INLINE RigidBlock<Real> sumBlocks(const ImplicitState<Real>& own,
                                  const typename Hierarchy<Real>::Block& block) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const bool isOfAll = block.column == ALL_VERTICES;
  const Four<Real>* centers = own.centers.data();
  const Four<Real> rowCenter = centers[block.row], columnCenter = isOfAll ? rowCenter : centers[block.column];
  RigidBlock<Real> sum;
  for (std::uint32_t k = block.firstSource; k < block.endSource; ++k) {
    const std::uint32_t number = hierarchy.sources[k] / 2;
    const bool isTransposed = hierarchy.sources[k] % 2 != 0;
    const auto& fine = hierarchy.blocks[number];
    const std::uint32_t row = isTransposed ? fine.column : fine.row,
                        column = isTransposed || isOfAll ? fine.row : fine.column;
    const Real weight =
        weightOf(own, row, block.row) * (isOfAll ? Real(1) : weightOf(own, column, block.column));
    const RigidBlock<Real>& stored = own.coarseBlocks[number];
    addShifted(sum, weight, isTransposed ? transposed(stored) : stored, centers[row] - rowCenter,
               centers[column] - columnCenter);
  }
  return sum;
}

template <class Real>
INLINE void coarsenRows(ImplicitState<Real>& own, bool isFirstLevel, std::uint32_t first, std::uint32_t end) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  std::array<Real, 6> scales, column;
  for (std::uint32_t row = first; row < end; ++row) {
    const std::uint32_t diagonal = hierarchy.blockStarts[row];
    for (std::uint32_t n = diagonal; n < (isFirstLevel ? diagonal : hierarchy.blockStarts[row + 1]); ++n)
      own.coarseBlocks[n] = canonical(sumBlocks(own, hierarchy.blocks[n]));
    SixColumns<Real> inverse = columnsOf(own.coarseBlocks[diagonal]);
    sweepOut(
        6, 0, scales.data(),
        column.data(), [&](std::size_t j) __attribute__((always_inline)) { return inverse[j].data(); });
    own.coarseInverses[row] = blockOf(inverse);
  }
}

VECTOR_CLONES(void, coarsenLevel,
              (ImplicitState<float> & own, bool isFirstLevel, std::uint32_t first, std::uint32_t end),
              (own, isFirstLevel, first, end), coarsenRows(own, isFirstLevel, first, end))
void coarsenLevel(ImplicitState<double>& own, bool isFirstLevel, std::uint32_t first, std::uint32_t end) {
  coarsenRows(own, isFirstLevel, first, end);
}

}  // namespace

template <class Real>
void coarsen(const ImplicitArguments<Real>& arguments, const LevelParams& level, std::uint32_t first,
             std::uint32_t end) {
  const bool isFirstLevel = level.fineFirst < arguments.own.hierarchy.particles;
  if (isFirstLevel) sumElements(arguments, level, first, end);
  coarsenLevel(arguments.own, isFirstLevel, first, end);
}

namespace {

template <class Real>
INLINE Vec3<Real> threeAt(const Real* first, std::size_t stride) {
  return {first[0], first[stride], first[2 * stride]};
}
template <class Real>
INLINE void addTo(Real* first, std::size_t stride, Vec3<Real> v) {
  first[0] = canonical(first[0] + v.x);
  first[stride] = canonical(first[stride] + v.y);
  first[2 * stride] = canonical(first[2 * stride] + v.z);
}

// The vertex that is held most stiffly from outside, the first of several: about it, all of them turn easily.
template <class Real>
INLINE std::uint32_t mostHeldOf(const ImplicitState<Real>& own, const DensePart& part) {
  std::uint32_t held = part.first;
  Real most = 0;
  for (std::uint32_t k = part.firstBlock; k < part.endBlock; ++k) {
    if (own.hierarchy.blocks[k].column != ALL_VERTICES) continue;
    const RigidBlock<Real>& block = own.coarseBlocks[k];
    const Real stiffness = (block.tt[0][0] + block.tt[1][1]) + block.tt[2][2];
    if (stiffness > most) held = own.hierarchy.blocks[k].row;
    most = stiffness > most ? stiffness : most;
  }
  return held;
}

// The unknowns of the vertex that is held most stiffly are replaced by the motion of all vertices as one
// rigid body about its center: A' = Q^T A Q. The cloth as a whole, which is soft, then has entries of its own
// and is no difference of stiff ones. At the end A^-1 = Q A'^-1 Q^T.
template <class Real>
INLINE void invertPart(ImplicitState<Real>& own, const DensePart& part) {
  const std::size_t order = 6 * static_cast<std::size_t>(part.count);
  const std::uint32_t held = mostHeldOf(own, part), end = part.first + part.count;
  const std::size_t all = 6 * static_cast<std::size_t>(held - part.first);
  Real* matrix = own.dense.data() + part.firstEntry;
  std::fill(matrix, matrix + order * order, Real(0));
  const auto offsetOf = [&](std::uint32_t vertex) __attribute__((always_inline)) {
    return own.centers[vertex] - own.centers[held];
  };
  const auto put = [&](const RigidBlock<Real>& block, std::size_t row, std::size_t column)
      __attribute__((always_inline)) {
    const SixColumns<Real> entries = columnsOf(block);
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t i = row == column ? j : 0; i < 6; ++i)
        matrix[(column + j) * order + row + i] = matrix[(row + i) * order + column + j] =
            canonical(entries[j][i]);
  };
  RigidBlock<Real> whole;
  for (std::uint32_t k = part.firstBlock; k < part.endBlock; ++k) {
    const auto& block = own.hierarchy.blocks[k];
    const std::size_t row = 6 * static_cast<std::size_t>(block.row - part.first);
    const RigidBlock<Real>& stored = own.coarseBlocks[k];
    if (block.column == ALL_VERTICES) {
      const Four<Real> offset = offsetOf(block.row);
      RigidBlock<Real> ofAll;
      addShifted(ofAll, Real(1), stored, Four<Real>{}, offset);
      addShifted(whole, Real(1), stored, offset, offset);
      if (row != all) put(ofAll, row, all);
    } else if (block.column < end && block.row != held && block.column != held) {  // across a cut it is 0
      put(stored, row, 6 * static_cast<std::size_t>(block.column - part.first));
    }
  }
  put(whole, all, all);
  std::array<Real, 6 * COARSEST_VERTICES> scales, column;
  // What moves all is swept out first, before the rounding of stiff differences is in it.
  sweepOut(
      order, all, scales.data(),
      column.data(), [=](std::size_t j) __attribute__((always_inline)) { return matrix + j * order; });
  // Rows, then columns: a vertex moves with all, t + r x offset, besides on its own.
  for (const std::size_t stride : {std::size_t{1}, order}) {
    const std::size_t across = order + 1 - stride;
    for (std::uint32_t vertex = part.first; vertex < end; ++vertex) {
      if (vertex == held) continue;
      const Vec3<Real> offset = threeOf(offsetOf(vertex));
      for (std::size_t j = 0; j < order; ++j) {
        const Real* ofAll = matrix + all * stride + j * across;
        Real* first = matrix + 6 * static_cast<std::size_t>(vertex - part.first) * stride + j * across;
        const Vec3<Real> t = threeAt(ofAll, stride), r = threeAt(ofAll + 3 * stride, stride);
        addTo(first, stride, t + cross(r, offset));
        addTo(first + 3 * stride, stride, r);
      }
    }
  }
}

}  // namespace

VECTOR_CLONES(void, invertDense, (ImplicitState<float> & own, const DensePart& part), (own, part),
              invertPart(own, part))
void invertDense(ImplicitState<double>& own, const DensePart& part) { invertPart(own, part); }

namespace {

// Places are from the first particle: where the cloth is in the world costs forces and motions no digits.
template <class Real>
INLINE Four<Real> centerOf(const ImplicitState<Real>& own, std::uint32_t coarse) {
  return own.centers.data()[coarse] - fourAt(arraysOf(std::as_const(own.iterate.positions)), 0);
}

// The residuals of particles as forces with a torque.
template <class Real>
INLINE void putForcesRange(ImplicitState<Real>& own, std::uint32_t first, std::uint32_t end) {
  const Arrays<const Real> x = arraysOf(std::as_const(own.iterate.positions)),
                           residuals = arraysOf(std::as_const(own.residuals));
  const Vec3<Real> origin = at(x, 0);
  Real* forces = numbersOf(own.forces.data());
#pragma GCC ivdep
  for (auto i = static_cast<std::ptrdiff_t>(first); i < static_cast<std::ptrdiff_t>(end); ++i) {
    const Vec3<Real> force = at(residuals, i);
    putThrees(forces, i, force, cross(at(x, i) - origin, force));
  }
}

template <class Real>
INLINE void restrictRange(ImplicitState<Real>& own, std::uint32_t first, std::uint32_t end) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const std::uint32_t* starts = hierarchy.restrictionStarts.data();
  const typename Hierarchy<Real>::Weight* hangs = hierarchy.restriction.data();
  RigidVector<Real>* forces = own.forces.data();
  for (std::uint32_t coarse = first; coarse < end; ++coarse) {
    Eight<Real> sum{};
    for (std::uint32_t n = starts[coarse]; n < starts[coarse + 1]; ++n)
      sum = sum + hangs[n].weight * forces[hangs[n].vertex].both;
    forces[hierarchy.particles + coarse].both = canonicalOf(sum);
  }
}

}  // namespace

VECTOR_CLONES(void, putForces, (ImplicitState<float> & own, std::uint32_t first, std::uint32_t end),
              (own, first, end), putForcesRange(own, first, end))
void putForces(ImplicitState<double>& own, std::uint32_t first, std::uint32_t end) {
  putForcesRange(own, first, end);
}
VECTOR_CLONES(void, restrictResiduals, (ImplicitState<float> & own, std::uint32_t first, std::uint32_t end),
              (own, first, end), restrictRange(own, first, end))
void restrictResiduals(ImplicitState<double>& own, std::uint32_t first, std::uint32_t end) {
  restrictRange(own, first, end);
}

namespace {

// Column by column, all rows at once: every row adds up in one order.
template <class Real>
INLINE void solvePart(ImplicitState<Real>& own, const DensePart& part) {
  const std::size_t order = 6 * static_cast<std::size_t>(part.count);
  std::array<Real, 6 * COARSEST_VERTICES> sums;
  std::fill_n(sums.data(), order, Real(0));
  const Real* column = own.dense.data() + part.firstEntry;
  for (std::uint32_t coarse = part.first; coarse < part.first + part.count; ++coarse) {
    const RigidVector<Real> force =
        forceAbout(centerOf(own, coarse), own.forces[own.hierarchy.particles + coarse]);
    for (std::size_t j = 0; j < 6; ++j, column += order) {
      const Real f = force.both[j < 3 ? j : j + 1];
      for (std::size_t i = 0; i < order; ++i) sums[i] = sums[i] - f * column[i];
    }
  }
  for (std::uint32_t k = 0; k < part.count; ++k) {
    const Real* s = sums.data() + 6 * static_cast<std::size_t>(k);
    const RigidVector<Real> motion(Four<Real>{s[0], s[1], s[2], Real(0)},
                                   Four<Real>{s[3], s[4], s[5], Real(0)});
    own.coarseCorrections[part.first + k] = canonical(motionFrom(centerOf(own, part.first + k), motion));
  }
}

}  // namespace

VECTOR_CLONES(void, solveCoarsest, (ImplicitState<float> & own, const DensePart& part), (own, part),
              solvePart(own, part))
void solveCoarsest(ImplicitState<double>& own, const DensePart& part) { solvePart(own, part); }

namespace {

// How the coarse vertices that a vertex hangs on move it.
template <class Real>
INLINE RigidVector<Real> prolonged(const ImplicitState<Real>& own, std::uint32_t vertex) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const std::uint32_t* starts = hierarchy.prolongationStarts.data();
  const typename Hierarchy<Real>::Weight* hangs = hierarchy.prolongation.data();
  const RigidVector<Real>* corrections = own.coarseCorrections.data();
  Eight<Real> sum{};
  for (std::uint32_t n = starts[vertex]; n < starts[vertex + 1]; ++n)
    sum = sum + hangs[n].weight * corrections[hangs[n].vertex].both;
  return RigidVector<Real>(sum);
}

// How the coarse vertices that particles hang on move them: of up to so many, and of those that share sixteen
// with them.
template <class Real>
struct alignas(SIXTEEN * sizeof(Real)) Motions {
  std::array<std::array<Real, PARTICLES_AT_ONCE + 2 * SIXTEEN>, 6> of;

  [[nodiscard]] INLINE Vec3<Real> translation(std::size_t k) const { return {of[0][k], of[1][k], of[2][k]}; }
  [[nodiscard]] INLINE Vec3<Real> rotation(std::size_t k) const { return {of[3][k], of[4][k], of[5][k]}; }
};
// The sums of prolonged() for sixteen particles, to `motions` from number `first` on.
template <class Real>
INLINE void prolongToSixteen(ImplicitState<Real>& own, std::size_t sixteen, Motions<Real>& motions,
                             std::size_t first) {
  const ProlongationBySixteen<Real>& by = own.toParticles;
  const Real* corrections = numbersOf(own.coarseCorrections.data());
  Sixteen<Real> sums[6]{};
  for (std::uint32_t n = by.starts[sixteen]; n < by.starts[sixteen + 1]; ++n) {
    const auto [coarse, number] = by.entries.data()[n];
    const auto weights = *reinterpret_cast<const Sixteen<Real>*>(by.weights.data() + number);
    const Real* motion = corrections + 8 * std::size_t{coarse};
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      sums[c] += weights * motion[c];
      sums[3 + c] += weights * motion[4 + c];
    }
  }
#pragma GCC unroll 6
  for (std::size_t c = 0; c < 6; ++c) std::memcpy(motions.of[c].data() + first, &sums[c], sizeof(sums[c]));
}

template <class Real>
INLINE void prolongRange(ImplicitState<Real>& own, const Real* inverseMasses, std::uint32_t first,
                         std::uint32_t end) {
  const Arrays<const Real> x = arraysOf(std::as_const(own.iterate.positions)),
                           residuals = arraysOf(std::as_const(own.residuals));
  const Arrays<Real> corrections = arraysOf(own.corrections);
  const SymmetricArrays<Real> factors = arraysOf(own.factors);
  Motions<Real> motions;
  const std::size_t start = first / SIXTEEN * SIXTEEN;
  for (std::size_t i = start; i < end; i += SIXTEEN) prolongToSixteen(own, i / SIXTEEN, motions, i - start);
  const Vec3<Real> origin = at(x, 0);
#pragma GCC ivdep
  for (auto i = static_cast<std::ptrdiff_t>(first); i < static_cast<std::ptrdiff_t>(end); ++i) {
    const std::size_t k = static_cast<std::size_t>(i) - start;
    const Symmetric<Real> stored = at(factors, i);
    const Vec3<Real> correction = solve(Factors<Real>{stored.others, stored.diagonal}, at(residuals, i)) +
                                  (motions.translation(k) + cross(motions.rotation(k), at(x, i) - origin));
    put(corrections, i, selected(inverseMasses[i] == Real(0), Vec3<Real>{}, canonical(correction)));
  }
}

template <class Real>
INLINE void prolongVertices(ImplicitState<Real>& own, std::uint32_t first, std::uint32_t end) {
  const std::uint32_t particles = own.hierarchy.particles;
  for (std::uint32_t coarse = first; coarse < end; ++coarse) {
    const Four<Real> center = centerOf(own, coarse);
    const RigidVector<Real> motion = prolonged(own, particles + coarse),
                            force = forceAbout(center, own.forces.data()[particles + coarse]),
                            minus = motionFrom(center, own.coarseInverses.data()[coarse] * force);
    own.coarseCorrections.data()[coarse].both = canonicalOf(motion.both - minus.both);
  }
}

}  // namespace

VECTOR_CLONES(void, prolong, (ImplicitState<float> & own, std::uint32_t first, std::uint32_t end),
              (own, first, end), prolongVertices(own, first, end))
void prolong(ImplicitState<double>& own, std::uint32_t first, std::uint32_t end) {
  prolongVertices(own, first, end);
}

VECTOR_CLONES(void, prolongParticles,
              (ImplicitState<float> & own, const float* inverseMasses, std::uint32_t first,
               std::uint32_t end),
              (own, inverseMasses, first, end), prolongRange(own, inverseMasses, first, end))
void prolongParticles(ImplicitState<double>& own, const double* inverseMasses, std::uint32_t first,
                      std::uint32_t end) {
  prolongRange(own, inverseMasses, first, end);
}

template <class Real>
LevelRanges levelRangesOf(const Hierarchy<Real>& hierarchy) {
  LevelRanges all;
  for (std::uint32_t piece = 0; piece < hierarchy.pieces.size(); ++piece) {
    const std::vector<LevelParams>& levels = hierarchy.pieces[piece];
    if (all.fine.size() < levels.size()) all.fine.resize(levels.size()), all.coarse.resize(levels.size());
    for (std::size_t k = 0; k < levels.size(); ++k) {
      all.fine[k].add(piece, levels[k].fineFirst, levels[k].fineCount);
      all.coarse[k].add(piece, levels[k].coarseFirst, levels[k].coarseCount);
    }
    all.parts.add(piece, 0, static_cast<std::uint32_t>(hierarchy.parts[piece].size()));
  }
  return all;
}

template <class Real>
void runOnLevel(PassCall call, std::span<const ImplicitArguments<Real>> pieces, ImplicitState<Real>& own,
                const Real* inverseMasses) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const LevelRanges& ranges = own.levelRanges;
  if (call.index >= ranges.fine.size()) return;
  const PieceRanges &fine = ranges.fine[call.index], &coarse = ranges.coarse[call.index];
  const bool isOfParticles = call.index == 0;
  const auto forEachPart = [&](const auto& work) {
    ranges.parts.forEach(1, [&](const PieceRange& s) {
      for (std::uint32_t k = s.begin; k < s.end; ++k) work(hierarchy.parts[s.piece][k]);
    });
  };
  switch (call.pass) {
    case Pass::invertDense:
      return forEachPart([&](const DensePart& part) { invertDense(own, part); });
    case Pass::solveCoarsest:
      return forEachPart([&](const DensePart& part) { solveCoarsest(own, part); });
    case Pass::findCenters:
      return coarse.forEach(VERTICES_AT_ONCE, [&](const PieceRange& s) {
        for (std::uint32_t i = s.begin; i < s.end; ++i) findCenter(own, i);
      });
    case Pass::coarsen:
      return coarse.forEach(isOfParticles ? firstRowsAtOnce(coarse.size()) : ROWS_AT_ONCE,
                            [&](const PieceRange& s) {
                              coarsen(pieces[s.piece], hierarchy.pieces[s.piece][call.index], s.begin, s.end);
                            });
    case Pass::restrict:
      if (isOfParticles)
        fine.forEach(PARTICLES_AT_ONCE, [&](const PieceRange& s) { putForces(own, s.begin, s.end); });
      return coarse.forEach(VERTICES_AT_ONCE,
                            [&](const PieceRange& s) { restrictResiduals(own, s.begin, s.end); });
    default:
      if (!isOfParticles)
        return fine.forEach(VERTICES_AT_ONCE, [&](const PieceRange& s) {
          prolong(own, s.begin - hierarchy.particles, s.end - hierarchy.particles);
        });
      return fine.forEach(PARTICLES_AT_ONCE, [&](const PieceRange& s) {
        for (std::uint32_t i = s.begin; i < s.end; i += PARTICLES_AT_ONCE)
          prolongParticles(own, inverseMasses, i, std::min(s.end, i + PARTICLES_AT_ONCE));
      });
  }
}

#define INSTANTIATE(Real)                                                                                  \
  template void findCenter(ImplicitState<Real>&, std::uint32_t);                                           \
  template void coarsen(const ImplicitArguments<Real>&, const LevelParams&, std::uint32_t, std::uint32_t); \
  template LevelRanges levelRangesOf(const Hierarchy<Real>&);                                              \
  template void runOnLevel(PassCall, std::span<const ImplicitArguments<Real>>, ImplicitState<Real>&,       \
                           const Real*);
INSTANTIATE(float)
INSTANTIATE(double)

}  // namespace clothsim::cpu
