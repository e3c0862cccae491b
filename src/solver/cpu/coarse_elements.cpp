// The first coarse level's matrix, from the elements of the cloth: springs, bending, and what acts on single
// particles; the twin of shaders/sim/implicit/coarsen_elements.comp. There, an invocation sums up a block;
// here an element is worked out once, and a particle's elements are added to all blocks that they touch, in
// the same order.
#include "solver/cpu/coarse_elements.h"

#include <algorithm>
#include <bit>

#include "solver/cpu/implicit_contact.h"
#include "solver/cpu/implicit_laws.h"
#include "solver/cpu/membrane_laws.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/spring_rows.h"

namespace clothsim::cpu {
namespace {

// The force of the element d on a body: (sigma d, y x d).
template <class Real>
INLINE Eight<Real> pullOf(Four<Real> lever, Vec3<Real> d) {
  const Vec3<Real> force = lever[0] * d, torque = cross(Vec3<Real>{lever[1], lever[2], lever[3]}, d);
  return Eight<Real>{force.x, force.y, force.z, 0, torque.x, torque.y, torque.z, 0};
}
// Adds the elements of some particles to the blocks of the rows [first, end).
template <class Real>
class ElementLoop {
 public:
  INLINE ElementLoop(const ImplicitArguments<Real>& arguments, std::uint32_t first, std::uint32_t end)
      : arguments_(arguments),
        pass_(arguments.step),
        own_(arguments.own),
        levels_(arguments.own.hierarchy),
        x_(arraysOf(std::as_const(own_.iterate.positions))),
        centers_(own_.centers),
        first_(first),
        end_(end) {}

  INLINE void addElementsOf(std::uint32_t i) {
    touched_ = levels_.touched.data() + levels_.touchedStarts[i];
    count_ = levels_.touchedStarts[i + 1] - levels_.touchedStarts[i];
    blocks_ = levels_.elementBlocks.data() + levels_.elementBlockStarts[i];
    if (count_ == 0 || touched_[0] >= end_ || touched_[count_ - 1] < first_) return;
    scratch_.resize(std::max<std::size_t>(scratch_.size(), 12 * std::size_t{count_}));
    pulling_.begin(2 * count_);
    isotropic_.begin(2 * count_);
    Four<Real>* own = leversIn(0);
    gatherLevers(i, own);
    addParticle(i, own);
    pass_.step.isMesh != 0 ? addMeshElements(i, own) : addGridElements(i, own);
    addToBlocks();
  }

 private:
  // Elements of one kind that wait to be added: the factors of the two sides of each, for each aggregate.
  template <class Vector>
  struct Waiting {
    static constexpr std::uint32_t MOST = 32;
    struct alignas(sizeof(Vector)) Factors {
      Vector left, right;
    };
    std::vector<Factors> factors;
    std::vector<std::uint32_t> acting;  // of an aggregate: a bit for each element that it moves
    std::uint32_t count = 0;

    void begin(std::uint32_t aggregates) {
      factors.resize(std::max<std::size_t>(factors.size(), MOST * std::size_t{aggregates}));
      acting.assign(aggregates, 0);
      count = 0;
    }
    // Calls make() for the factors.
    template <class Make>
    INLINE void add(std::uint32_t aggregate, Make make) {
      acting[aggregate] |= 1u << count;
      factors[aggregate * MOST + count] = make();
    }
    // Calls add(left, right) for the elements that both aggregates move, in order.
    template <class Add>
    INLINE void forEach(std::uint32_t a, std::uint32_t b, Add add) const {
      const Factors *ofA = factors.data() + a * MOST, *ofB = factors.data() + b * MOST;
      for (std::uint32_t both = acting[a] & acting[b]; both != 0; both &= both - 1) {
        const auto element = static_cast<std::uint32_t>(std::countr_zero(both));
        add(ofA[element].left, ofB[element].right);
      }
    }
  };

  INLINE void addGridElements(std::uint32_t i, const Four<Real>* own) {
    const std::uint32_t place = i - pass_.step.firstParticle, column = place % pass_.step.columns,
                        row = place / pass_.step.columns;
    const std::uint32_t cut = pass_.cutMasks != nullptr ? pass_.cutMasks[i] : 0;
    for (std::uint32_t k = 0; k < SPRING_SLOTS; ++k) addGridSpring(i, own, k, column, row, cut);
    if (pass_.step.hasMaterial != 0) addLines(i, own, column, row, cut);
  }
  INLINE void addMeshElements(std::uint32_t i, const Four<Real>* own) {
    addMeshSprings(i, own);
    addHinges(i);
    addMembranes(i, own);
  }

  // One of six rows of scratch, with two levers for each aggregate that the elements touch: its own, and
  // behind them that of all vertices, moving as one body about its center.
  INLINE Four<Real>* leversIn(std::size_t row) { return &scratch_[2 * row * count_].lever; }

  // With what weight a particle hangs on each aggregate, and that times where it is from the center; 0 for
  // others, and if it is pinned.
  INLINE void gatherOwnLevers(std::uint32_t i, Four<Real>* levers) const {
    std::fill(levers, levers + count_, Four<Real>{});
    if (pass_.inverseMasses[i] == Real(0)) return;
    const Vec3<Real> x = at(x_, i);
    std::uint32_t a = 0;
    for (std::uint32_t n = levels_.prolongationStarts[i]; n < levels_.prolongationStarts[i + 1]; ++n) {
      const auto& [vertex, weight] = levels_.prolongation[n];
      while (touched_[a] != vertex) ++a;
      const Vec3<Real> y = weight * (x - threeOf(centers_[vertex]));
      levers[a] = Four<Real>{weight, y.x, y.y, y.z};
    }
  }
  // The same on all vertices, where the weight is 1.
  INLINE void gatherLeversOfAll(std::uint32_t i, Four<Real>* levers) const {
    const bool isPinned = pass_.inverseMasses[i] == Real(0);
    const Vec3<Real> x = at(x_, i);
    for (std::uint32_t a = 0; a < count_; ++a) {
      const Vec3<Real> y = x - threeOf(centers_[touched_[a]]);
      levers[count_ + a] = isPinned ? Four<Real>{} : Four<Real>{1, y.x, y.y, y.z};
    }
  }
  INLINE void gatherLevers(std::uint32_t i, Four<Real>* levers) const {
    gatherOwnLevers(i, levers);
    gatherLeversOfAll(i, levers);
  }
  INLINE static bool isNone(Four<Real> lever) {
    return lever[0] == 0 && lever[1] == 0 && lever[2] == 0 && lever[3] == 0;
  }

  // s p p^T, p = (sigma, y): the element s |sigma t + r x y|^2 / 2 of a body of translation t and rotation r.
  INLINE void addIsotropicElement(Real s, const Four<Real>* levers) {
    if (isotropic_.count == isotropic_.MOST) addToBlocks();
    const auto add = [&](std::uint32_t a) __attribute__((always_inline)) {
      isotropic_.add(a, [&] { return typename Waiting<Four<Real>>::Factors{s * levers[a], levers[a]}; });
    };
    for (std::uint32_t a = 0; a < count_; ++a)
      if (!isNone(levers[a])) add(a), add(count_ + a);
    ++isotropic_.count;
  }
  // `isRigid`: all vertices together, moving as one body, do not change it.
  INLINE void addPullingElement(Real s, Vec3<Real> d, const Four<Real>* levers, bool isRigid) {
    if (pulling_.count == pulling_.MOST) addToBlocks();
    const auto add = [&](std::uint32_t a) __attribute__((always_inline)) {
      pulling_.add(a, [&] {
        const Eight<Real> pull = pullOf(levers[a], d);
        return typename Waiting<Eight<Real>>::Factors{s * pull, pull};
      });
    };
    for (std::uint32_t a = 0; a < count_; ++a) {
      if (isNone(levers[a])) continue;
      add(a);
      if (!isRigid) add(count_ + a);
    }
    ++pulling_.count;
  }
  // A force of each edge: the element |sum of scales_k pulls_k|^2 / 2 of edges that are d_k long, with their
  // levers in rows 3 to 5 of the scratch.
  INLINE void addEdgesElement(const std::array<Vec3<Real>, 3>& d, const OfEdges<Real>& scales, bool isRigid) {
    if (pulling_.count == pulling_.MOST) addToBlocks();
    const auto add = [&](std::uint32_t a) __attribute__((always_inline)) {
      pulling_.add(a, [&] {
        const Eight<Real> pull =
            (scales[0] * pullOf(leversIn(3)[a], d[0]) + scales[1] * pullOf(leversIn(4)[a], d[1])) +
            scales[2] * pullOf(leversIn(5)[a], d[2]);
        return typename Waiting<Eight<Real>>::Factors{pull, pull};
      });
    };
    for (std::uint32_t a = 0; a < count_; ++a) {
      if (isNone(leversIn(3)[a]) && isNone(leversIn(4)[a]) && isNone(leversIn(5)[a])) continue;
      add(a);
      if (!isRigid) add(count_ + a);
    }
    ++pulling_.count;
  }
  // What waits goes to the blocks of pairs of aggregates, and of aggregates with all vertices.
  INLINE void addToBlocks() {
    const std::uint32_t* block = blocks_;
    for (std::uint32_t a = 0; a < count_; block += count_ - a + 1, ++a) {
      if (touched_[a] < first_ || touched_[a] >= end_) continue;
      for (std::uint32_t b = a; b < count_; ++b) addToBlock(block[b - a], a, b);
      addToBlock(block[count_ - a], a, count_ + a);
    }
    pulling_.begin(2 * count_);
    isotropic_.begin(2 * count_);
  }
  INLINE void addToBlock(std::uint32_t number, std::uint32_t a, std::uint32_t b) {
    if (((pulling_.acting[a] & pulling_.acting[b]) | (isotropic_.acting[a] & isotropic_.acting[b])) == 0)
      return;
    ElementSums<Real> sums = own_.elementSums[number];
    pulling_.forEach(a, b, [&](const Eight<Real>& scaled, const Eight<Real>& q) {
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
        sums.columns[c] += scaled * q[c];
        sums.columns[3 + c] += scaled * q[4 + c];
      }
    });
    isotropic_.forEach(a, b, [&](const Four<Real>& scaled, const Four<Real>& q) {
#pragma GCC unroll 4
      for (int c = 0; c < 4; ++c) sums.moments[c] += scaled * q[c];
    });
    own_.elementSums[number] = sums;
  }

  // Inertia, air, grabs and the collider that is touched.
  INLINE void addParticle(std::uint32_t i, const Four<Real>* levers) {
    const auto n = static_cast<std::ptrdiff_t>(i);
    Real stiffness = own_.diagonal[i];
    if (pass_.step.hasWind != 0) {
      const Vec3<Real> air = at(own_.air, n).diagonal;
      stiffness = stiffness + static_cast<Real>(0x1.555556p-2f) * ((air.x + air.y) + air.z);
    }
    addIsotropicElement(stiffness, levers);
    if (hasContacts(arguments_))
      addPullingElement(contactStiffness(arguments_, n), at(own_.planes.normals, n), levers, false);
    forEachPairOf(own_.touching, n, [&](std::uint32_t q, std::uint32_t place) {
      const SurfacePair<Real>& pair = own_.touching.pairs[q];
      const Real weight = pair.weights[place];
      if (pair.held > Real(0)) addPullingElement((weight * weight) * pair.held, pair.normal, levers, false);
    });
  }

  INLINE void addSpring(std::uint32_t i, std::uint32_t other, const Four<Real>* own, Real stiffness,
                        Real restLength, Real limitLength) {
    Four<Real>* levers = leversIn(1);
    gatherOwnLevers(other, levers);
    const Vec3<Real> d = at(x_, other) - at(x_, i);
    const auto [across, along] =
        springBlock(d, stiffness, restLength, pass_.step.limitStiffness, limitLength);
    const bool isRigid = pass_.inverseMasses[i] > Real(0) && pass_.inverseMasses[other] > Real(0),
               needsAll = !isRigid || across > Real(0);
    if (needsAll) gatherLeversOfAll(other, levers);
    for (std::uint32_t a = 0; a < (needsAll ? 2 * count_ : count_); ++a) levers[a] = levers[a] - own[a];
    addPullingElement(along, d, levers, isRigid);
    if (across > Real(0)) addIsotropicElement(across, levers);
  }

  INLINE void addGridSpring(std::uint32_t i, const Four<Real>* own, std::uint32_t k, std::uint32_t column,
                            std::uint32_t row, std::uint32_t cut) {
    const StepParams<Real>& step = pass_.step;
    const IncidentSpring& incident = incidentSprings[k];
    const auto otherColumn = static_cast<std::uint32_t>(static_cast<int>(column) + incident.columns),
               otherRow = static_cast<std::uint32_t>(static_cast<int>(row) + incident.rows);
    if ((step.enabledSlots >> incident.slot & 1u) == 0 || otherColumn >= step.columns ||
        otherRow >= step.rows || (cut >> k & 1u) != 0)
      return;
    const SpringParams<Real>& spring = step.springs[incident.slot];
    const bool onBorder = (incident.slot == toLeft && isBorder(row, step.rows)) ||
                          (incident.slot == toUpper && isBorder(column, step.columns));
    const Real stiffness =
        step.hasMaterial != 0 && onBorder ? Real(0.5) * spring.stiffness : spring.stiffness;
    Real rest = spring.restLength, limit = spring.limitLength;
    if (step.useRestLengthTable != 0) {
      rest = pass_.restLengths[static_cast<std::size_t>(incident.slot) * step.totalParticles + i];
      limit = step.limitFactor * rest;
    }
    addSpring(i, step.firstParticle + otherRow * step.columns + otherColumn, own, stiffness, rest, limit);
  }

  INLINE void addLines(std::uint32_t i, const Four<Real>* own, std::uint32_t column, std::uint32_t row,
                       std::uint32_t cut) {
    const StepParams<Real>& step = pass_.step;
    const bool borderRow = isBorder(row, step.rows), borderColumn = isBorder(column, step.columns);
    if (!borderColumn && (cut & BENDING_ROW) == 0)
      addLine(i, 1, own, borderRow ? Real(0.5) * step.bendAlongRow : step.bendAlongRow);
    if (!borderRow && (cut & BENDING_COLUMN) == 0)
      addLine(i, step.columns, own, borderColumn ? Real(0.5) * step.bendAlongColumn : step.bendAlongColumn);
  }
  INLINE void addLine(std::uint32_t i, std::uint32_t stride, const Four<Real>* own, Real b) {
    const Real* w = pass_.inverseMasses;
    const bool endOfClamp = w[i] == Real(0) && (w[i - stride] == Real(0)) != (w[i + stride] == Real(0));
    Four<Real>*before = leversIn(1), *behind = leversIn(2);
    gatherLevers(i - stride, before);
    gatherLevers(i + stride, behind);
    for (std::uint32_t a = 0; a < 2 * count_; ++a) before[a] = (before[a] - own[a]) + (behind[a] - own[a]);
    addIsotropicElement(endOfClamp ? Real(2) * b : b, before);
  }

  INLINE void addMeshSprings(std::uint32_t i, const Four<Real>* own) {
    const MeshLists<Real>& lists = pass_.lists;
    for (std::uint32_t n = lists.starts[i].springs; n < lists.starts[i + 1].springs; ++n) {
      const auto& spring = lists.springs[n];
      const bool doesNothing = spring.stiffness == Real(0) && pass_.step.limitStiffness == Real(0);
      if (spring.other > i || doesNothing) continue;
      addSpring(i, spring.other, own, spring.stiffness, spring.restLength,
                pass_.step.limitFactor * spring.restLength);
    }
  }
  INLINE void addHinges(std::uint32_t i) {
    const MeshLists<Real>& lists = pass_.lists;
    for (std::uint32_t n = lists.starts[i].hinges; n < lists.starts[i + 1].hinges; ++n) {
      if (lists.numbers[n] % 4 != 0) continue;
      const auto& [corners, c] = lists.hinges[lists.numbers[n] / 4];
      Four<Real>*bent = leversIn(1), *corner = leversIn(2);
      std::fill(bent, bent + 2 * std::size_t{count_}, Four<Real>{});
      for (std::size_t k = 0; k < 4; ++k) {
        gatherLevers(corners[k], corner);
        for (std::uint32_t a = 0; a < 2 * count_; ++a) bent[a] = bent[a] + c[k] * corner[a];
      }
      addIsotropicElement(Real(1), bent);
    }
  }

  INLINE void addMembranes(std::uint32_t i, const Four<Real>* own) {
    const MeshLists<Real>& lists = pass_.lists;
    for (std::uint32_t n = lists.starts[i].membranes; n < lists.starts[i + 1].membranes; ++n)
      if (lists.numbers[n] % 4 == 0) addMembrane(lists.membranes[lists.numbers[n] / 4], own);
  }
  // Of the particle at hand, its first corner.
  INLINE void addMembrane(const typename MeshLists<Real>::MembraneParams& membrane, const Four<Real>* own) {
    const auto& [corners, restSquared, roots] = membrane;
    Four<Real>*second = leversIn(1), *third = leversIn(2);
    gatherLevers(corners[1], second);
    gatherLevers(corners[2], third);
    for (std::uint32_t a = 0; a < 2 * count_; ++a) {
      leversIn(3)[a] = third[a] - second[a];
      leversIn(4)[a] = own[a] - third[a];
      leversIn(5)[a] = second[a] - own[a];
    }
    const std::array<Vec3<Real>, 3> d = edgesOf(corners, own_.iterate.positions);
    const OfEdges<Real> tensions = positiveTensions(roots, strainsOf(restSquared, d));
    const Real* w = pass_.inverseMasses;
    const bool isRigid = w[corners[0]] > Real(0) && w[corners[1]] > Real(0) && w[corners[2]] > Real(0);
    const auto& [xx, xy, xz, yy, yz, zz] = roots;
    addEdgesElement(d, {xx, xy, xz}, isRigid);
    addEdgesElement(d, {0, yy, yz}, isRigid);
    addEdgesElement(d, {0, 0, zz}, isRigid);
    for (std::size_t k = 0; k < 3; ++k)
      if (tensions[k] != Real(0)) addIsotropicElement(tensions[k], leversIn(3 + k));
  }

  const ImplicitArguments<Real>& arguments_;
  const PassArguments<Real>& pass_;
  ImplicitState<Real>& own_;
  const Hierarchy<Real>& levels_;
  const Arrays<const Real> x_;
  const std::vector<Four<Real>>& centers_;
  std::uint32_t first_, end_;  // rows
  // Of the particle at hand: the aggregates that its elements touch, and the blocks of all pairs of them.
  const std::uint32_t *touched_ = nullptr, *blocks_ = nullptr;
  std::uint32_t count_ = 0;
  // A std::vector of bare vector types would not be aligned as they are.
  struct alignas(4 * sizeof(Real)) LeverCell {
    Four<Real> lever;
  };
  std::vector<LeverCell> scratch_;
  Waiting<Eight<Real>> pulling_;
  Waiting<Four<Real>> isotropic_;
};

// What the sums make of a block: see addIsotropic(), and cross products in components.
template <class Real>
INLINE RigidBlock<Real> blockOfSums(const ElementSums<Real>& sums) {
  const auto& m = sums.moments;
  RigidBlock<Real> block;
  const auto three = [](const Eight<Real>& v, int first) __attribute__((always_inline)) {
    return Four<Real>{v[first], v[first + 1], v[first + 2], Real(0)};
  };
  for (std::size_t c = 0; c < 3; ++c) {
    const Eight<Real>&t = sums.columns[c], &r = sums.columns[3 + c];
    block.tt[c] = three(t, 0);
    block.rt[c] = three(t, 4);
    block.tr[c] = three(r, 0);
    block.rr[c] = three(r, 4);
    block.tt[c][c] += m[0][0];
  }
  const Four<Real> u{m[1][0], m[2][0], m[3][0], 0}, v{m[0][1], m[0][2], m[0][3], 0};
  const Real trace = (m[1][1] + m[2][2]) + m[3][3];
  // e x u, v x e
  block.tr[0] += Four<Real>{0, -u[2], u[1], 0};
  block.tr[1] += Four<Real>{u[2], 0, -u[0], 0};
  block.tr[2] += Four<Real>{-u[1], u[0], 0, 0};
  block.rt[0] += Four<Real>{0, v[2], -v[1], 0};
  block.rt[1] += Four<Real>{-v[2], 0, v[0], 0};
  block.rt[2] += Four<Real>{v[1], -v[0], 0, 0};
  // trace e - column of sum s y_q y_p^T
  const auto minus = [&](int c) __attribute__((always_inline)) {
    return Four<Real>{m[1][1 + c], m[2][1 + c], m[3][1 + c], 0};
  };
  block.rr[0] += Four<Real>{trace, 0, 0, 0} - minus(0);
  block.rr[1] += Four<Real>{0, trace, 0, 0} - minus(1);
  block.rr[2] += Four<Real>{0, 0, trace, 0} - minus(2);
  return block;
}

template <class Real>
INLINE void sumRows(const ImplicitArguments<Real>& arguments, const LevelParams& level, std::uint32_t first,
                    std::uint32_t end) {
  ImplicitState<Real>& own = arguments.own;
  const Hierarchy<Real>& levels = own.hierarchy;
  std::uint32_t firstParticle = level.fineFirst + level.fineCount, endParticle = 0;
  for (std::uint32_t row = first; row < end; ++row) {
    const auto& diagonal = levels.blocks[levels.blockStarts[row]];
    firstParticle = std::min(firstParticle, levels.sources[diagonal.firstSource]);
    endParticle = std::max(endParticle, levels.sources[diagonal.endSource - 1] + 1);
  }
  for (std::uint32_t n = levels.blockStarts[first]; n < levels.blockStarts[end]; ++n) own.elementSums[n] = {};
  ElementLoop<Real> loop(arguments, first, end);
  for (std::uint32_t i = firstParticle; i < endParticle; ++i) loop.addElementsOf(i);
  for (std::uint32_t n = levels.blockStarts[first]; n < levels.blockStarts[end]; ++n)
    own.coarseBlocks[n] = blockOfSums(own.elementSums[n]);
}

}  // namespace

VECTOR_CLONES(void, sumElements,
              (const ImplicitArguments<float>& arguments, const LevelParams& level, std::uint32_t first,
               std::uint32_t end),
              (arguments, level, first, end), sumRows(arguments, level, first, end))
void sumElements(const ImplicitArguments<double>& arguments, const LevelParams& level, std::uint32_t first,
                 std::uint32_t end) {
  sumRows(arguments, level, first, end);
}

}  // namespace clothsim::cpu
