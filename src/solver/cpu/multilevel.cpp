// From level to level of the implicit integrator's preconditioner; the twin of
// shaders/sim/implicit/{find_centers,coarsen,invert_dense}.comp and {restriction,dense,prolongation}.glsl.
#include "solver/cpu/coarse_elements.h"
#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/rigid_block.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

// Where a vertex is: a particle, or the center of an aggregate.
template <class Real>
INLINE Vec3<Real> placeOf(const ImplicitState<Real>& own, std::uint32_t vertex) {
  return vertex < own.hierarchy.particles
             ? at(own.iterate.positions, vertex)
             : at(own.centers, static_cast<std::ptrdiff_t>(vertex - own.hierarchy.particles));
}

template <class Real>
INLINE std::ptrdiff_t entryOfVertex(const ImplicitState<Real>& own, std::uint32_t coarse) {
  return static_cast<std::ptrdiff_t>(own.hierarchy.particles + VERTEX_TEXELS * coarse);
}
// Of a coarse vertex.
template <class Real>
INLINE RigidVector<Real> rigidAt(const ImplicitState<Real>& own, const Components<Real>& c,
                                 std::uint32_t coarse) {
  const std::ptrdiff_t i = entryOfVertex(own, coarse);
  return {at(c, i), at(c, i + 1)};
}
template <class Real>
INLINE void putRigid(const ImplicitState<Real>& own, Components<Real>& c, std::uint32_t coarse,
                     const RigidVector<Real>& v) {
  const std::ptrdiff_t i = entryOfVertex(own, coarse);
  put(c, i, canonical(v.translation));
  put(c, i + 1, canonical(v.rotation));
}

template <class Real>
INLINE void makeCanonical(RigidBlock<Real>& block) {
  for (auto* columns : {&block.tt, &block.tr, &block.rt, &block.rr})
    for (Vec3<Real>& column : *columns) column = canonical(column);
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
  Vec3<Real> sum{};
  Real weights = 0;
  for (std::uint32_t n = hierarchy.restrictionStarts[coarse]; n < hierarchy.restrictionStarts[coarse + 1];
       ++n) {
    const auto& [vertex, weight] = hierarchy.restriction[n];
    sum = sum + weight * placeOf(own, vertex);
    weights = weights + weight;
  }
  put(own.centers, static_cast<std::ptrdiff_t>(coarse), canonical(reciprocal(weights) * sum));
}

template <class Real>
RigidBlock<Real> sumBlocks(const ImplicitState<Real>& own, const typename Hierarchy<Real>::Block& block) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const bool isOfAll = block.column == ALL_VERTICES;
  const Vec3<Real> rowCenter = at(own.centers, block.row),
                   columnCenter = isOfAll ? rowCenter : at(own.centers, block.column);
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
    addShifted(sum, weight, isTransposed ? transposed(stored) : stored, at(own.centers, row) - rowCenter,
               at(own.centers, column) - columnCenter);
  }
  return sum;
}

template <class Real>
void coarsen(const ImplicitArguments<Real>& arguments, const LevelParams& level, std::uint32_t first,
             std::uint32_t end) {
  ImplicitState<Real>& own = arguments.own;
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const bool isFirstLevel = level.fineFirst < hierarchy.particles;
  if (isFirstLevel) sumElements(arguments, level, first, end);
  std::array<Real, 6> began, column;
  for (std::uint32_t n = hierarchy.blockStarts[first]; n < hierarchy.blockStarts[end]; ++n) {
    const auto& block = hierarchy.blocks[n];
    if (!isFirstLevel) own.coarseBlocks[n] = sumBlocks(own, block);
    makeCanonical(own.coarseBlocks[n]);
    if (block.row != block.column) continue;
    RigidBlock<Real> inverse = own.coarseBlocks[n];
    sweepOut(6, began.data(), column.data(),
             [&](std::size_t i, std::size_t j) -> Real& { return entryOf(inverse, i, j); });
    own.coarseInverses[block.row] = inverse;
  }
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

}  // namespace

// The place of the last vertex have all of them, moving as one rigid body about its center: A' = Q^T A Q. So
// what is soft, the cloth as a whole, has entries of its own, and is no difference of stiff ones. At the end
// A^-1 = Q A'^-1 Q^T.
template <class Real>
void invertDense(ImplicitState<Real>& own, const DensePart& part) {
  const std::size_t order = 6 * static_cast<std::size_t>(part.count), last = order - 6;
  const std::uint32_t lastVertex = part.first + part.count - 1;
  Real* matrix = own.dense.data() + part.firstEntry;
  std::fill(matrix, matrix + order * order, Real(0));
  const auto offsetOf = [&](std::uint32_t vertex) {
    return at(own.centers, vertex) - at(own.centers, lastVertex);
  };
  const auto put = [&](RigidBlock<Real>& block, std::size_t row, std::size_t column) {
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t i = row == column ? j : 0; i < 6; ++i)
        matrix[(column + j) * order + row + i] = matrix[(row + i) * order + column + j] =
            canonical(entryOf(block, i, j));
  };
  RigidBlock<Real> whole;
  for (std::uint32_t k = part.firstBlock; k < part.endBlock; ++k) {
    const auto& block = own.hierarchy.blocks[k];
    const std::size_t row = 6 * static_cast<std::size_t>(block.row - part.first);
    RigidBlock<Real> stored = own.coarseBlocks[k];
    if (block.column == ALL_VERTICES) {
      const Vec3<Real> offset = offsetOf(block.row);
      RigidBlock<Real> ofAll;
      addShifted(ofAll, Real(1), stored, Vec3<Real>{}, offset);
      addShifted(whole, Real(1), stored, offset, offset);
      if (row != last) put(ofAll, row, last);
    } else if (block.column < lastVertex) {  // beyond: across a cut, where it is 0
      put(stored, row, 6 * static_cast<std::size_t>(block.column - part.first));
    }
  }
  put(whole, last, last);
  std::vector<Real> began(order), column(order);
  sweepOut(order, began.data(), column.data(),
           [=](std::size_t i, std::size_t j) -> Real& { return matrix[j * order + i]; });
  // Rows, then columns: a vertex moves with all, t + r x offset, besides on its own.
  for (const std::size_t stride : {std::size_t{1}, order}) {
    const std::size_t across = order + 1 - stride;
    for (std::uint32_t vertex = part.first; vertex < lastVertex; ++vertex) {
      const Vec3<Real> offset = offsetOf(vertex);
      for (std::size_t j = 0; j < order; ++j) {
        const Real* all = matrix + last * stride + j * across;
        Real* first = matrix + 6 * static_cast<std::size_t>(vertex - part.first) * stride + j * across;
        const Vec3<Real> t = threeAt(all, stride), r = threeAt(all + 3 * stride, stride);
        addTo(first, stride, t + cross(r, offset));
        addTo(first + 3 * stride, stride, r);
      }
    }
  }
}

template <class Real>
void restrictResidual(ImplicitState<Real>& own, std::uint32_t coarse) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const Vec3<Real> center = at(own.centers, static_cast<std::ptrdiff_t>(coarse));
  RigidVector<Real> sum{};
  for (std::uint32_t n = hierarchy.restrictionStarts[coarse]; n < hierarchy.restrictionStarts[coarse + 1];
       ++n) {
    const auto& [vertex, weight] = hierarchy.restriction[n];
    const bool isParticle = vertex < hierarchy.particles;
    const RigidVector<Real> force =
        isParticle ? RigidVector<Real>{at(own.residuals, static_cast<std::ptrdiff_t>(vertex)), {}}
                   : rigidAt(own, own.residuals, vertex - hierarchy.particles);
    const Vec3<Real> torque = cross(placeOf(own, vertex) - center, force.translation) + force.rotation;
    sum.translation = sum.translation + weight * force.translation;
    sum.rotation = sum.rotation + weight * torque;
  }
  putRigid(own, own.residuals, coarse, sum);
}

template <class Real>
void solveCoarsest(ImplicitState<Real>& own, const DensePart& part, std::uint32_t vertex) {
  const std::size_t order = 6 * static_cast<std::size_t>(part.count);
  const Real* matrix = own.dense.data() + part.firstEntry + 6 * static_cast<std::size_t>(vertex - part.first);
  RigidVector<Real> sum{};
  for (std::uint32_t k = 0; k < part.count; ++k) {
    const RigidVector<Real> residual = rigidAt(own, own.residuals, part.first + k);
    const std::array<Real, 6> r{residual.translation.x, residual.translation.y, residual.translation.z,
                                residual.rotation.x,    residual.rotation.y,    residual.rotation.z};
    for (std::size_t j = 0; j < 6; ++j) {
      const Real* column = matrix + (6 * k + j) * order;
      sum.translation = sum.translation - r[j] * Vec3<Real>{column[0], column[1], column[2]};
      sum.rotation = sum.rotation - r[j] * Vec3<Real>{column[3], column[4], column[5]};
    }
  }
  putRigid(own, own.corrections, vertex, sum);
}

namespace {

// What the coarse vertices that a vertex hangs on make of it.
template <class Real>
INLINE RigidVector<Real> prolonged(const ImplicitState<Real>& own, std::uint32_t vertex) {
  const Hierarchy<Real>& hierarchy = own.hierarchy;
  const Vec3<Real> place = placeOf(own, vertex);
  RigidVector<Real> sum{};
  for (std::uint32_t n = hierarchy.prolongationStarts[vertex]; n < hierarchy.prolongationStarts[vertex + 1];
       ++n) {
    const auto& [coarse, weight] = hierarchy.prolongation[n];
    const RigidVector<Real> motion = rigidAt(own, own.corrections, coarse);
    const Vec3<Real> arm = place - at(own.centers, static_cast<std::ptrdiff_t>(coarse));
    sum.translation = sum.translation + weight * (motion.translation + cross(motion.rotation, arm));
    sum.rotation = sum.rotation + weight * motion.rotation;
  }
  return sum;
}

}  // namespace

template <class Real>
void prolong(ImplicitState<Real>& own, const Real* inverseMasses, std::uint32_t vertex) {
  const RigidVector<Real> motion = prolonged(own, vertex);
  if (vertex < own.hierarchy.particles) {
    const auto i = static_cast<std::ptrdiff_t>(vertex);
    const Symmetric<Real> stored = at(own.factors, i);
    const Vec3<Real> correction =
        solve(Factors<Real>{stored.others, stored.diagonal}, at(own.residuals, i)) + motion.translation;
    put(own.corrections, i, inverseMasses[i] == Real(0) ? Vec3<Real>{} : canonical(correction));
    return;
  }
  const std::uint32_t coarse = vertex - own.hierarchy.particles;
  const RigidVector<Real> minus = own.coarseInverses[coarse] * rigidAt(own, own.residuals, coarse);
  putRigid(own, own.corrections, coarse,
           RigidVector<Real>{motion.translation - minus.translation, motion.rotation - minus.rotation});
}

#define INSTANTIATE(Real)                                                                                  \
  template void findCenter(ImplicitState<Real>&, std::uint32_t);                                           \
  template void coarsen(const ImplicitArguments<Real>&, const LevelParams&, std::uint32_t, std::uint32_t); \
  template void invertDense(ImplicitState<Real>&, const DensePart&);                                       \
  template void restrictResidual(ImplicitState<Real>&, std::uint32_t);                                     \
  template void solveCoarsest(ImplicitState<Real>&, const DensePart&, std::uint32_t);                      \
  template void prolong(ImplicitState<Real>&, const Real*, std::uint32_t);
INSTANTIATE(float)
INSTANTIATE(double)

}  // namespace clothsim::cpu
