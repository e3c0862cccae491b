// The first coarse level's matrix, from the elements of the cloth: springs, bending, and what acts on single
// particles; the twin of shaders/sim/implicit/coarsen_elements.comp. There, an invocation sums up a block;
// here an element is worked out once, and a particle's elements are added to all blocks that they touch, in
// the same order. It is worked out for all aggregates that any of them touches, with levers of 0 where this
// one does not: nothing is searched or told apart.
#include "solver/cpu/coarse_elements.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "solver/cpu/implicit_contact.h"
#include "solver/cpu/implicit_laws.h"
#include "solver/cpu/membrane_laws.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/seam_passes.h"
#include "solver/cpu/spring_rows.h"

namespace clothsim::cpu {
namespace {

// The force of the element d on a body: (sigma d, y x d), with a 0 behind either.
template <class Real>
INLINE Eight<Real> pullOf(Four<Real> lever, Four<Real> d) {
  return __builtin_shufflevector(lever[3] * d, crossOf(lever, d), 0, 1, 2, 3, 4, 5, 6, 7);
}
// p q^T, of forces and torques.
template <class Real>
INLINE void addOuter(ElementSums<Real>& sums, Eight<Real> p, const Eight<Real>& q) {
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    sums.columns[c] += p * q[c];
    sums.columns[3 + c] += p * q[4 + c];
  }
}

// p q^T of levers, two columns at once: p twice, and each number of q four times.
template <class Real>
struct Spread {
  Eight<Real> first, second;
};
template <class Real>
INLINE Spread<Real> spreadOf(Four<Real> q) {
  return {__builtin_shufflevector(q, q, 0, 0, 0, 0, 1, 1, 1, 1),
          __builtin_shufflevector(q, q, 2, 2, 2, 2, 3, 3, 3, 3)};
}
template <class Real>
INLINE void addMoments(ElementSums<Real>& sums, Four<Real> p, const Spread<Real>& q) {
  const Eight<Real> twice = __builtin_shufflevector(p, p, 0, 1, 2, 3, 0, 1, 2, 3);
  sums.moments[0] += twice * q.first;
  sums.moments[1] += twice * q.second;
}

// Adds the elements of some particles to the blocks of the rows [first, end) of a level. Its sums begin as 0
// and are never -0, so that it is all the same whether a 0 is added.
template <class Real>
class ElementLoop {
 public:
  INLINE ElementLoop(const ImplicitArguments<Real>& arguments, const LevelParams& level, std::uint32_t first,
                     std::uint32_t end)
      : arguments_(arguments),
        pass_(arguments.step),
        own_(arguments.own),
        levels_(arguments.own.hierarchy),
        x_(arraysOf(std::as_const(own_.iterate.positions))),
        starts_(arraysOf(pass_.before.positions)),
        centers_(own_.centers.data()),
        sums_(own_.elementSums.data()),
        first_(first),
        end_(end),
        levelFirst_(level.coarseFirst),
        numberOf_(std::make_unique_for_overwrite<std::uint32_t[]>(level.coarseCount)) {}

  INLINE void addElementsOf(std::uint32_t i) {
    const std::uint32_t* touched = levels_.touched.data() + levels_.touchedStarts[i];
    count_ = levels_.touchedStarts[i + 1] - levels_.touchedStarts[i];
    if (count_ == 0 || touched[0] >= end_ || touched[count_ - 1] < first_) return;
    if (count_ > touched_.size()) {
      touched_.resize(count_);
      pulls_.resize(MOST * std::size_t{count_});
      turns_.resize(MOST * std::size_t{count_});
    }
    const std::uint32_t* blocks = levels_.elementBlocks.data() + levels_.elementBlockStarts[i];
    const Vertex vertex = vertexAt(i);
    Touched* aggregates = touched_.data();
    for (std::uint32_t a = 0; a < count_; blocks += count_ - a + 1, ++a) {
      Touched& aggregate = aggregates[a];
      numberOf_[touched[a] - levelFirst_] = a;
      aggregate.center = centers_[touched[a]];
      aggregate.blocks = touched[a] >= first_ && touched[a] < end_ ? blocks : nullptr;
      aggregate.levers[0] = Four<Real>{};
      aggregate.all = leverOfAll(vertex, aggregate);
      aggregate.hangsOwn = 0;
    }
    vertices_[0] = vertex;
    forEachLever(
        i, vertex, [&](Touched & aggregate, Four<Real> lever) __attribute__((always_inline)) {
          aggregate.levers[0] = lever;
          aggregate.hangsOwn = 1;
        });
    addParticle(i);
    pass_.step.isMesh != 0 ? addMeshElements(i) : addGridElements(i);
    addToBlocks();
  }

 private:
  // A particle: its place and a 1, and whether it is free, 1, or pinned, 0.
  struct alignas(4 * sizeof(Real)) Vertex {
    Four<Real> x;
    Real isFree;
  };
  // One of the aggregates that the elements of the particle at hand touch. Structs of vectors say how they
  // are aligned, or a std::vector of them would not be.
  struct alignas(4 * sizeof(Real)) Touched {
    Four<Real> center{};
    // How vertices of the element hang on it: (weight times where they are from the center, weight); 0 for
    // others, and if they are pinned. The first is the particle at hand.
    Four<Real> levers[3]{};
    Four<Real> all{};                            // of that particle on all vertices
    std::uint32_t hangsOwn = 0, hangsOther = 0;  // 1: that particle, another vertex of the element does
    std::uint32_t pulls = 0, turns = 0;          // that act on it: a bit each
    const std::uint32_t* blocks = nullptr;       // from the diagonal on; null if others sum up the row
  };
  // What elements make of an aggregate, before they are added to the blocks: the factors of their two sides,
  // and the second of all vertices, moving as one body about its center. MOST of either kind wait.
  static constexpr std::uint32_t MOST = 32;  // the bits of Touched::pulls and turns
  // s p q^T of forces, of an element with a direction.
  struct alignas(8 * sizeof(Real)) Pull {
    Eight<Real> left, right, all;
  };
  // s p q^T of levers, of one without.
  struct alignas(8 * sizeof(Real)) Turn {
    Spread<Real> right;
    Four<Real> left, all;
  };

  INLINE Vertex vertexAt(std::uint32_t i) const {
    const auto n = static_cast<std::ptrdiff_t>(i);
    return {Four<Real>{x_.x[n], x_.y[n], x_.z[n], Real(1)},
            pass_.inverseMasses[i] == Real(0) ? Real(0) : Real(1)};
  }
  // Calls visit(aggregate, lever) for those that the particle hangs on.
  template <class Visit>
  INLINE void forEachLever(std::uint32_t i, const Vertex& vertex, Visit visit) {
    if (vertex.isFree == Real(0)) return;
    for (std::uint32_t n = levels_.prolongationStarts[i]; n < levels_.prolongationStarts[i + 1]; ++n) {
      const auto& [coarse, weight] = levels_.prolongation[n];
      Touched& aggregate = touched_.data()[numberOf_[coarse - levelFirst_]];
      visit(aggregate, weight * (vertex.x - aggregate.center));
    }
  }
  // The same on all vertices.
  INLINE static Four<Real> leverOfAll(const Vertex& vertex, const Touched& aggregate) {
    return vertex.isFree * (vertex.x - aggregate.center);
  }
  // Vertex k of the element, 1 or 2; the particle at hand is vertex 0.
  INLINE void setVertex(std::size_t k, std::uint32_t particle) {
    vertices_[k] = vertexAt(particle);
    forEachLever(
        particle, vertices_[k], [&](Touched & aggregate, Four<Real> lever) __attribute__((always_inline)) {
          aggregate.levers[k] = lever;
          aggregate.hangsOther = 1;
        });
  }
  // For the most that an element has: a membrane's three of either kind.
  INLINE void makeRoom() {
    if (pullCount_ + 3 > MOST || turnCount_ + 3 > MOST) addToBlocks();
  }
  // Calls make(a, acts, aggregate) for all; acts: 1 where a vertex of the element hangs on it, otherwise 0.
  // It has `others` vertices besides the particle at hand.
  template <int others, class Make>
  INLINE void forEachTouched(Make make) {
    Touched* aggregates = touched_.data();
    const std::uint32_t count = count_;
    for (std::uint32_t a = 0; a < count; ++a) {
      Touched& aggregate = aggregates[a];
      make(a, aggregate.hangsOwn | aggregate.hangsOther, aggregate);
      for (int k = 1; k <= others; ++k) aggregate.levers[k] = Four<Real>{};
      if (others > 0) aggregate.hangsOther = 0;
    }
  }

  // s p p^T, p = (y, sigma): the element s |sigma t + r x y|^2 / 2 of a body of translation t and rotation r.
  // `number`: its place among those that wait.
  INLINE void putTurn(Turn* turns, std::uint32_t a, std::uint32_t number, std::uint32_t acts,
                      Touched& aggregate, Real s, Four<Real> lever, Four<Real> all) {
    turns[a * MOST + number] = {spreadOf<Real>(lever), s * lever, all};
    aggregate.turns |= acts << number;
  }
  INLINE void putPull(Pull* pulls, std::uint32_t a, std::uint32_t number, std::uint32_t acts,
                      Touched& aggregate, Real s, Eight<Real> pull) {
    pulls[a * MOST + number].left = s * pull;
    pulls[a * MOST + number].right = pull;
    aggregate.pulls |= acts << number;
  }

  // What waits goes to the blocks of pairs of aggregates, and of aggregates with all vertices.
  INLINE void addToBlocks() {
    const Pull* pulls[MOST];
    const Turn* turns[MOST];
    const std::uint32_t count = count_;
    Touched* aggregates = touched_.data();
    for (std::uint32_t a = 0; a < count; ++a) {
      Touched& aggregate = aggregates[a];
      const std::uint32_t* block = aggregate.blocks;
      std::uint32_t pullCount = 0, turnCount = 0;
      for (std::uint32_t left = aggregate.pulls; left != 0; left &= left - 1)
        pulls[pullCount++] = pulls_.data() + std::countr_zero(left);
      for (std::uint32_t left = aggregate.turns; left != 0; left &= left - 1)
        turns[turnCount++] = turns_.data() + std::countr_zero(left);
      const std::uint32_t turning = aggregate.pulls & pullsOfAll_;
      aggregate.pulls = aggregate.turns = 0;
      if (block == nullptr) continue;
      for (std::uint32_t b = a; b < count; ++b) {
        ElementSums<Real> sums = sums_[block[b - a]];
        for (std::uint32_t k = 0; k < pullCount; ++k)
          addOuter<Real>(sums, pulls[k][a * MOST].left, pulls[k][b * MOST].right);
        for (std::uint32_t k = 0; k < turnCount; ++k)
          addMoments<Real>(sums, turns[k][a * MOST].left, turns[k][b * MOST].right);
        sums_[block[b - a]] = sums;
      }
      ElementSums<Real>& ofAll = sums_[block[count - a]];
      for (std::uint32_t left = turning; left != 0; left &= left - 1) {
        const Pull& pull = pulls_[a * MOST + static_cast<std::uint32_t>(std::countr_zero(left))];
        addOuter<Real>(ofAll, pull.left, pull.all);
      }
      for (std::uint32_t k = 0; k < turnCount; ++k)
        addMoments<Real>(ofAll, turns[k][a * MOST].left, spreadOf<Real>(turns[k][a * MOST].all));
    }
    pullCount_ = turnCount_ = pullsOfAll_ = 0;
  }

  // Inertia, air, grabs, the collider that is touched, and seams as if what they are sewn to stood still.
  INLINE void addParticle(std::uint32_t i) {
    const auto n = static_cast<std::ptrdiff_t>(i);
    Real stiffness = own_.diagonal[i];
    if (pass_.step.hasWind != 0) {
      const Vec3<Real> air = at(own_.air, n).diagonal;
      stiffness = stiffness + static_cast<Real>(0x1.555556p-2f) * ((air.x + air.y) + air.z);
    }
    if (hasSeams(pass_))
      for (std::uint32_t k = pass_.lists.seamStarts[i]; k < pass_.lists.seamStarts[i + 1]; ++k)
        stiffness = stiffness + pass_.lists.seamSprings[k].stiffness;
    const std::uint32_t number = turnCount_++;
    Turn* turns = turns_.data();
    forEachTouched<0>([&](std::uint32_t a, std::uint32_t acts,
                          Touched & aggregate) __attribute__((always_inline)) {
      putTurn(turns, a, number, acts, aggregate, stiffness, aggregate.levers[0], aggregate.all);
    });
    if (hasContacts(arguments_)) {
      const Vec3<Real> normal = at(own_.planes.normals, n);
      if (normal != Vec3<Real>{}) addPush(contactStiffness(arguments_, n), fourOf(normal));
    }
    forEachPairOf(own_.touching.all, n, [&](std::uint32_t q, std::uint32_t place) {
      const SurfacePair<Real>& pair = own_.touching.pairs[q];
      const Real weight = pair.weights[place];
      if (pair.held > Real(0)) addPush((weight * weight) * pair.held, fourOf(pair.normal));
    });
  }
  INLINE void addPush(Real s, Four<Real> normal) {
    makeRoom();
    Pull* pulls = pulls_.data();
    const std::uint32_t number = pullCount_++;
    forEachTouched<0>([&](std::uint32_t a, std::uint32_t acts,
                          Touched & aggregate) __attribute__((always_inline)) {
      putPull(pulls, a, number, acts, aggregate, s, pullOf<Real>(aggregate.levers[0], normal));
      pulls[a * MOST + number].all = pullOf<Real>(aggregate.all, normal);
    });
    pullsOfAll_ |= 1u << number;
  }

  // Tension is that of the start of the step: straight motions, with which the search begins, stretch what
  // turns, and would make turning stiff.
  INLINE void addSpring(std::uint32_t own, std::uint32_t other, Real stiffness, Real restLength,
                        Real limitLength) {
    setVertex(1, other);
    const Vertex from = vertices_[0], to = vertices_[1];
    const Four<Real> d = to.x - from.x;
    const Vec3<Real> atStart =
        at(starts_, static_cast<std::ptrdiff_t>(other)) - at(starts_, static_cast<std::ptrdiff_t>(own));
    const auto blockOf = [&](Vec3<Real> way) __attribute__((always_inline)) {
      return springBlock(way, stiffness, restLength, pass_.step.limitStiffness, limitLength);
    };
    const Real along = blockOf(threeOf(d)).along, across = blockOf(atStart).across;
    makeRoom();
    Pull* pulls = pulls_.data();
    Turn* turns = turns_.data();
    const std::uint32_t pull = pullCount_++, turn = turnCount_, hasTurn = across > Real(0) ? 1 : 0;
    turnCount_ += hasTurn;
    if (from.isFree * to.isFree == Real(0)) {
      for (std::uint32_t a = 0; a < count_; ++a)
        pulls[a * MOST + pull].all = pullOf<Real>(leverOfAll(to, touched_[a]) - touched_[a].all, d);
      pullsOfAll_ |= 1u << pull;
    }
    forEachTouched<1>([&](std::uint32_t a, std::uint32_t acts, Touched & aggregate)
                          __attribute__((always_inline)) {
                            const Four<Real> lever = aggregate.levers[1] - aggregate.levers[0];
                            putPull(pulls, a, pull, acts, aggregate, along, pullOf<Real>(lever, d));
                            putTurn(turns, a, turn, acts & hasTurn, aggregate, across, lever,
                                    leverOfAll(to, aggregate) - aggregate.all);
                          });
  }

  INLINE void addGridElements(std::uint32_t i) {
    const std::uint32_t place = i - pass_.step.firstParticle, column = place % pass_.step.columns,
                        row = place / pass_.step.columns;
    const std::uint32_t cut = pass_.cutMasks != nullptr ? pass_.cutMasks[i] : 0;
    for (std::uint32_t k = 0; k < SPRING_SLOTS; ++k) addGridSpring(i, k, column, row, cut);
    if (pass_.step.hasMaterial != 0) addLines(i, column, row, cut);
  }
  INLINE void addGridSpring(std::uint32_t i, std::uint32_t k, std::uint32_t column, std::uint32_t row,
                            std::uint32_t cut) {
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
    addSpring(i, step.firstParticle + otherRow * step.columns + otherColumn, stiffness, rest, limit);
  }

  INLINE void addLines(std::uint32_t i, std::uint32_t column, std::uint32_t row, std::uint32_t cut) {
    const StepParams<Real>& step = pass_.step;
    const bool borderRow = isBorder(row, step.rows), borderColumn = isBorder(column, step.columns);
    const struct {
      bool exists, isHalved;
      std::uint32_t stride;
      Real stiffness;
    } lines[]{{!borderColumn && (cut & BENDING_ROW) == 0, borderRow, 1, step.bendAlongRow},
              {!borderRow && (cut & BENDING_COLUMN) == 0, borderColumn, step.columns, step.bendAlongColumn}};
    for (const auto& line : lines)
      if (line.exists) addLine(i, line.stride, line.isHalved ? Real(0.5) * line.stiffness : line.stiffness);
  }
  INLINE void addLine(std::uint32_t i, std::uint32_t stride, Real b) {
    setVertex(1, i - stride);
    setVertex(2, i + stride);
    const Vertex before = vertices_[1], behind = vertices_[2];
    const bool endOfClamp = vertices_[0].isFree == Real(0) && before.isFree != behind.isFree;
    const Real stiffness = endOfClamp ? Real(2) * b : b;
    makeRoom();
    Turn* turns = turns_.data();
    const std::uint32_t number = turnCount_++;
    forEachTouched<2>([&](std::uint32_t a, std::uint32_t acts,
                          Touched & aggregate) __attribute__((always_inline)) {
      const Four<Real> own = aggregate.levers[0], all = aggregate.all;
      putTurn(turns, a, number, acts, aggregate, stiffness,
              (aggregate.levers[1] - own) + (aggregate.levers[2] - own),
              (leverOfAll(before, aggregate) - all) + (leverOfAll(behind, aggregate) - all));
    });
  }

  INLINE void addMeshElements(std::uint32_t i) {
    addMeshSprings(i);
    addHinges(i);
    addMembranes(i);
  }
  INLINE void addMeshSprings(std::uint32_t i) {
    const MeshLists<Real>& lists = pass_.lists;
    for (std::uint32_t n = lists.starts[i].springs; n < lists.starts[i + 1].springs; ++n) {
      const auto& spring = lists.springs[n];
      const bool doesNothing = spring.stiffness == Real(0) && pass_.step.limitStiffness == Real(0);
      if (spring.other > i || doesNothing) continue;
      addSpring(i, spring.other, spring.stiffness, spring.restLength,
                pass_.step.limitFactor * spring.restLength);
    }
  }
  INLINE void addHinges(std::uint32_t i) {
    const MeshLists<Real>& lists = pass_.lists;
    for (std::uint32_t n = lists.starts[i].hinges; n < lists.starts[i + 1].hinges; ++n) {
      if (lists.numbers[n] % 4 != 0) continue;
      const auto& corners = lists.hinges[lists.numbers[n] / 4].corners;
      const auto& c = lists.hinges[lists.numbers[n] / 4].coefficients;
      std::array<Vertex, 4> vertices;
      for (std::size_t k = 0; k < 4; ++k) {
        vertices[k] = vertexAt(corners[k]);
        forEachLever(
            corners[k],
            vertices[k], [&](Touched & aggregate, Four<Real> lever) __attribute__((always_inline)) {
              aggregate.levers[1] = aggregate.levers[1] + c[k] * lever;
              aggregate.hangsOther = 1;
            });
      }
      makeRoom();
      Turn* turns = turns_.data();
      const std::uint32_t number = turnCount_++;
      forEachTouched<1>([&](std::uint32_t a, std::uint32_t acts, Touched & aggregate)
                            __attribute__((always_inline)) {
                              Four<Real> all{};
                              for (std::size_t k = 0; k < 4; ++k)
                                all = all + c[k] * leverOfAll(vertices[k], aggregate);
                              putTurn(turns, a, number, acts, aggregate, Real(1), aggregate.levers[1], all);
                            });
    }
  }

  INLINE void addMembranes(std::uint32_t i) {
    const MeshLists<Real>& lists = pass_.lists;
    for (std::uint32_t n = lists.starts[i].membranes; n < lists.starts[i + 1].membranes; ++n)
      if (lists.numbers[n] % 4 == 0) addMembrane(lists.membranes[lists.numbers[n] / 4]);
  }
  // Of the particle at hand, its first corner.
  INLINE void addMembrane(const typename MeshLists<Real>::MembraneParams& membrane) {
    const auto& [corners, restSquared, roots] = membrane;
    setVertex(1, corners[1]);
    setVertex(2, corners[2]);
    const std::array<Vec3<Real>, 3> edges = edgesOf(corners, own_.iterate.positions);
    const OfEdges<Real> tensions =
        positiveTensions(roots, strainsOf(restSquared, edgesOf(corners, pass_.before.positions)));
    const Four<Real> d[3]{fourOf(edges[0]), fourOf(edges[1]), fourOf(edges[2])};
    const Vertex first = vertices_[0], second = vertices_[1], third = vertices_[2];
    const auto& [xx, xy, xz, yy, yz, zz] = roots;
    const OfEdges<Real> rows[3]{{xx, xy, xz}, {0, yy, yz}, {0, 0, zz}};
    makeRoom();
    Pull* pulls = pulls_.data();
    Turn* turns = turns_.data();
    const std::uint32_t firstPull = pullCount_;
    std::uint32_t hasTurn[3], turnAt[3];
    for (std::size_t k = 0; k < 3; ++k) {
      hasTurn[k] = tensions[k] != Real(0) ? 1 : 0;
      turnAt[k] = turnCount_;
      turnCount_ += hasTurn[k];
    }
    pullCount_ += 3;
    const auto pullOfRow = [&](int k, const Eight<Real>* edgePulls) __attribute__((always_inline)) {
      return (rows[k][0] * edgePulls[0] + rows[k][1] * edgePulls[1]) + rows[k][2] * edgePulls[2];
    };
    const bool isRigid = (first.isFree * second.isFree) * third.isFree != Real(0);
    if (!isRigid) pullsOfAll_ |= 7u << firstPull;
    forEachTouched<2>([&](std::uint32_t a, std::uint32_t acts,
                          Touched & aggregate) __attribute__((always_inline)) {
      const Four<Real>* own = aggregate.levers;
      const Four<Real> levers[3]{own[2] - own[1], own[0] - own[2], own[1] - own[0]};
      const Four<Real> x = aggregate.all, y = leverOfAll(second, aggregate), z = leverOfAll(third, aggregate);
      const Four<Real> all[3]{z - y, x - z, y - x};
      Eight<Real> pull[3];
      for (int k = 0; k < 3; ++k) pull[k] = pullOf<Real>(levers[k], d[k]);
      for (int k = 0; k < 3; ++k)
        putPull(pulls, a, firstPull + static_cast<std::uint32_t>(k), acts, aggregate, Real(1),
                pullOfRow(k, pull));
      for (std::size_t k = 0; k < 3; ++k)
        putTurn(turns, a, turnAt[k], acts & hasTurn[k], aggregate, tensions[k], levers[k], all[k]);
      if (isRigid) return;
      for (int k = 0; k < 3; ++k) pull[k] = pullOf<Real>(all[k], d[k]);
      for (int k = 0; k < 3; ++k)
        pulls[a * MOST + firstPull + static_cast<std::uint32_t>(k)].all = pullOfRow(k, pull);
    });
  }

  const ImplicitArguments<Real>& arguments_;
  const PassArguments<Real>& pass_;
  ImplicitState<Real>& own_;
  const Hierarchy<Real>& levels_;
  const Arrays<const Real> x_, starts_;
  const Four<Real>* centers_;
  ElementSums<Real>* sums_;
  std::uint32_t first_, end_;  // rows
  std::uint32_t levelFirst_;
  std::unique_ptr<std::uint32_t[]> numberOf_;  // of those of the level that are touched
  // Of the particle at hand.
  std::uint32_t count_ = 0;  // of `touched_`
  std::vector<Touched> touched_;
  std::array<Vertex, 3> vertices_{};  // of the element at hand
  // Elements that wait to be added.
  std::uint32_t pullCount_ = 0, turnCount_ = 0;
  std::uint32_t pullsOfAll_ = 0;  // a bit for each that pulls all vertices together, too
  std::vector<Pull> pulls_;       // of each aggregate, MOST
  std::vector<Turn> turns_;
};

// What the sums make of a block: see addIsotropic(), and cross products in components.
template <class Real>
INLINE RigidBlock<Real> blockOfSums(const ElementSums<Real>& sums) {
  const auto m = [&](int row, int column) __attribute__((always_inline)) {
    return sums.moments[column / 2][4 * (column % 2) + row];
  };
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
    block.tt[c][c] += m(3, 3);
  }
  const Four<Real> u{m(3, 0), m(3, 1), m(3, 2), 0}, v{m(0, 3), m(1, 3), m(2, 3), 0};
  const Real trace = (m(0, 0) + m(1, 1)) + m(2, 2);
  // e x u, v x e
  block.tr[0] += Four<Real>{0, -u[2], u[1], 0};
  block.tr[1] += Four<Real>{u[2], 0, -u[0], 0};
  block.tr[2] += Four<Real>{-u[1], u[0], 0, 0};
  block.rt[0] += Four<Real>{0, v[2], -v[1], 0};
  block.rt[1] += Four<Real>{-v[2], 0, v[0], 0};
  block.rt[2] += Four<Real>{v[1], -v[0], 0, 0};
  // trace e - column of sum s y_q y_p^T
  const auto minus = [&](int c) __attribute__((always_inline)) {
    return Four<Real>{m(c, 0), m(c, 1), m(c, 2), 0};
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
  ElementLoop<Real> loop(arguments, level, first, end);
  // A row's sums are few and in use for a while: cleared when its first particle comes, blocks after its
  // last.
  std::uint32_t clear = first, done = first;
  for (std::uint32_t i = firstParticle; i < endParticle; ++i) {
    const std::uint32_t touched = levels.touchedStarts[i + 1];
    if (touched == levels.touchedStarts[i]) continue;
    for (const std::uint32_t stop = std::min(end, levels.touched[touched - 1] + 1); clear < stop; ++clear)
      for (std::uint32_t n = levels.blockStarts[clear]; n < levels.blockStarts[clear + 1]; ++n)
        own.elementSums[n] = {};
    loop.addElementsOf(i);
    for (; done < clear && levels.sources[levels.blocks[levels.blockStarts[done]].endSource - 1] <= i; ++done)
      for (std::uint32_t n = levels.blockStarts[done]; n < levels.blockStarts[done + 1]; ++n)
        own.coarseBlocks[n] = canonical(blockOfSums(own.elementSums[n]));
  }
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
