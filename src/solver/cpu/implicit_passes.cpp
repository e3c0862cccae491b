#include "solver/cpu/implicit_passes.h"

#include <algorithm>

#include "solver/cpu/implicit_contact.h"
#include "solver/cpu/implicit_laws.h"
#include "solver/cpu/mesh_implicit.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/seam_passes.h"
#include "solver/cpu/spring_rows.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {
namespace {

// Where the changes of energy by the lengths [first, end) are summed up.
template <std::size_t first, std::size_t end, class Real>
struct Trials {
  std::array<Real*, LENGTHS_TRIED> of;

  // Adds change(l) for each length l.
  template <class Change>
  INLINE void add(std::ptrdiff_t i, bool counts, Change change) const {
#pragma GCC unroll 4
    for (std::size_t k = first; k < end; ++k) {
      const Real sum = of[k][i] + change(lengthTried<Real>(k));
      of[k][i] = counts ? sum : of[k][i];
    }
  }
};

template <bool hasCuts, class Trials, class Real>
INLINE void addSpringTrials(const ImplicitArguments<Real>& arguments, const Trials& trials, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const Arrays<const Real> x = arraysOf(std::as_const(arguments.own.iterate.positions)),
                           increments = arraysOf(std::as_const(arguments.own.increments));
  const std::uint32_t* cutMasks = pass.cutMasks;
  const Real limitStiffness = pass.step.limitStiffness, limitFactor = pass.step.limitFactor;
  forEachSpringRange(
      pass, row,
      [=](Range particles, SpringPlace place, const SpringParams<Real> spring, auto rest)
          __attribute__((always_inline)) {
            if (!incidentSprings[place.bit].owned) return;
#pragma GCC ivdep
            for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
              const Vec3<Real> d = at(x, i + place.other) - at(x, i),
                               e = at(increments, i + place.other) - at(increments, i);
              const Real limit = limitLength(rest, i, limitFactor, spring.limitLength);
              trials.add(
                  i, !isCutAt<hasCuts>(cutMasks, i, place.bit), [&](Real l) __attribute__((always_inline)) {
                    return springChange(d, e, l, spring.stiffness, rest[i], limitStiffness, limit);
                  });
            }
          });
}

// Bending stiffness of the line through particle `m`, by `stride` between its particles.
template <class Real>
INLINE Real lineStiffness(const Real* w, std::ptrdiff_t m, std::ptrdiff_t stride, Real b) {
  const auto isPinned = [=](std::ptrdiff_t k) __attribute__((always_inline)) {
    return w[k] == Real(0) ? Real(1) : Real(0);
  };
  const Real change = isPinned(m - stride) - isPinned(m + stride);  // not 0 at the end of a clamp
  return b + (isPinned(m) * (change * change)) * b;
}

// Lines of three particles around the middle ones: b (l k.dk + l^2/2 |dk|^2), k = (m - a) + (m - c).
template <bool hasCuts, class Trials, class Real>
INLINE void addLineTrials(const ImplicitArguments<Real>& arguments, const Trials& trials, Range middles,
                          std::ptrdiff_t stride, Real b, std::uint32_t link) {
  const Arrays<const Real> x = arraysOf(std::as_const(arguments.own.iterate.positions)),
                           increments = arraysOf(std::as_const(arguments.own.increments));
  const Real* w = arguments.step.inverseMasses;
  const std::uint32_t* cutMasks = arguments.step.cutMasks;
  const auto curvature = [=](const Arrays<const Real>& c, std::ptrdiff_t i) __attribute__((always_inline)) {
    const Vec3<Real> m = at(c, i);
    return (m - at(c, i - stride)) + (m - at(c, i + stride));
  };
#pragma GCC ivdep
  for (std::ptrdiff_t i = middles.begin; i < middles.end; ++i) {
    bool counts = true;
    if constexpr (hasCuts) counts = (cutMasks[i] & link) == 0;
    const Real stiffness = lineStiffness(w, i, stride, b);
    const Vec3<Real> k = curvature(x, i), dk = curvature(increments, i);
    const Real first = dot(k, dk), second = dot(dk, dk);
    trials.add(
        i, counts, [&](Real l) __attribute__((always_inline)) {
          return (stiffness * l) * (first + (Real(0.5) * l) * second);
        });
  }
}

template <bool hasCuts, class Trials, class Real>
INLINE void addBendingTrials(const ImplicitArguments<Real>& arguments, const Trials& trials, int row) {
  const StepParams<Real>& step = arguments.step.step;
  const Range inside = rangeOf(step, row, -1, 1);
  const bool borderRow = isBorder(row, step.rows);
  addLineTrials<hasCuts>(arguments, trials, inside, 1,
                         borderRow ? Real(0.5) * step.bendAlongRow : step.bendAlongRow, BENDING_ROW);
  if (borderRow) return;
  forEachPart(
      rangeOf(step, row), true, [&](Range middles, bool isEnd) __attribute__((always_inline)) {
        addLineTrials<hasCuts>(arguments, trials, middles, indexOffset(step, 0, 1),
                               isEnd ? Real(0.5) * step.bendAlongColumn : step.bendAlongColumn,
                               BENDING_COLUMN);
      });
}

// Of the plane in which a particle touches a collider.
template <class Trials, class Real>
INLINE void addPlaneTrials(const ImplicitArguments<Real>& arguments, const Trials& trials, Range all) {
  ImplicitState<Real>& own = arguments.own;
  const Real slow = slowSlip(arguments.step.step);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> e = at(own.increments, i), d = at(own.displacements, i),
                     normal = at(own.planes.normals, i);
    const Real over = own.planes.offsets.data()[i] - dot(normal, d), fall = dot(normal, e),
               stiffness = contactStiffness(arguments, i), limit = own.planes.limits.data()[i];
    const Vec3<Real> slip = slipOf(own.planes, i, d), slide = e - fall * normal;
    const Real resisted = frictionPotential(slip, slow);
    trials.add(
        i, dot(normal, normal) > Real(0), [&](Real l) __attribute__((always_inline)) {
          return contactChange(stiffness, over, over - l * fall) +
                 limit * (frictionPotential(slip + l * slide, slow) - resisted);
        });
  }
}

template <std::size_t firstLength, std::size_t endLength, class Real>
INLINE void tryLengthsOf(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(pass.step, row);
  const Trials<firstLength, endLength, Real> trials{
      {own.trials[0].data(), own.trials[1].data(), own.trials[2].data(), own.trials[3].data()}};
  const Arrays<Real> increments = arraysOf(own.increments), displacements = arraysOf(own.displacements),
                     rightHandSide = arraysOf(own.rightHandSide);
  const SymmetricArrays<Real> air = arraysOf(own.air);
  const Real* diagonal = own.diagonal.data();
  const auto begin = [&]<bool hasAir>() __attribute__((always_inline)) {
#pragma GCC ivdep
    for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
      const Vec3<Real> e = at(increments, i), d = at(displacements, i);
      Vec3<Real> force = diagonal[i] * d, product = diagonal[i] * e;
      if constexpr (hasAir) {
        force = force + at(air, i) * d;
        product = product + at(air, i) * e;
      }
      const Real first = dot(force - at(rightHandSide, i), e), second = Real(0.5) * dot(product, e);
#pragma GCC unroll 4
      for (std::size_t k = firstLength; k < endLength; ++k) {
        const Real l = lengthTried<Real>(k);
        trials.of[k][i] = l * (first + l * second);
      }
    }
  };
  pass.step.hasWind != 0 ? begin.template operator()<true>() : begin.template operator()<false>();
  if (!own.touching.pairs.empty())
    for (std::ptrdiff_t i = all.begin; i < all.end; ++i) addPairTrials(own, i, slowSlip(pass.step));
  if (hasContacts(arguments)) addPlaneTrials(arguments, trials, all);
  if (hasSeams(pass)) addSeamTrials(arguments, row);
  if (pass.step.isMesh != 0) return addMeshTrials(arguments, row);
  const auto addGrid = [&]<bool hasCuts>() __attribute__((always_inline)) {
    addSpringTrials<hasCuts>(arguments, trials, row);
    if (pass.step.hasMaterial != 0) addBendingTrials<hasCuts>(arguments, trials, row);
  };
  pass.cutMasks != nullptr ? addGrid.template operator()<true>() : addGrid.template operator()<false>();
}
template <class Real>
INLINE void tryLengthsRow(const ImplicitArguments<Real>& arguments, int row) {
  arguments.own.triesShorter ? tryLengthsOf<1, LENGTHS_TRIED>(arguments, row)
                             : tryLengthsOf<0, 1>(arguments, row);
}

// The diagonal block, from the springs; those that a particle owns are kept for the products.
template <bool hasCuts, class Real>
INLINE void addSpringBlocks(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Arrays<Real> x = arraysOf(own.iterate.positions);
  const SymmetricArrays<Real> blocks = arraysOf(own.factors);
  const std::uint32_t* cutMasks = pass.cutMasks;
  const Real limitStiffness = pass.step.limitStiffness, limitFactor = pass.step.limitFactor;
  const bool isExact = own.scalars.hessian == HESSIAN_EXACT;
  forEachSpringRange(
      pass, row,
      [&](Range particles, SpringPlace place, const SpringParams<Real>& spring, auto rest)
          __attribute__((always_inline)) {
            const IncidentSpring& incident = incidentSprings[place.bit];
            Real *keptAcross = own.elements.across[incident.slot].data(),
                 *keptAlong = own.elements.along[incident.slot].data();
#pragma GCC ivdep
            for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
              const Vec3<Real> d = at(x, i + place.other) - at(x, i);
              const Real limit = limitLength(rest, i, limitFactor, spring.limitLength);
              const auto [across, along] = springBlock(d, spring.stiffness, rest[i], limitStiffness, limit);
              Symmetric<Real> k = outerProduct(along, d);
              k.diagonal = k.diagonal + Vec3<Real>{across, across, across};
              const bool isCut = isCutAt<hasCuts>(cutMasks, i, place.bit);
              addTo(blocks, i, (isCut ? Real(0) : Real(1)) * k);
              if (!incident.owned) continue;
              const SpringBlock<Real> kept =
                  springBlock(d, spring.stiffness, rest[i], limitStiffness, limit, isExact);
              keptAcross[i] = isCut ? Real(0) : kept.across;
              keptAlong[i] = isCut ? Real(0) : kept.along;
            }
          });
}

// A line of three particles: from one of them to the middle, and from that to the ends.
template <class Real>
struct BendingLine {
  std::ptrdiff_t offset, stride;
  Real stiffness;  // 0 where there is no such line
  std::uint32_t cut;
};
template <class Real>
INLINE BendingLine<Real> bendingLine(bool isThere, std::ptrdiff_t offset, std::ptrdiff_t stride, Real b,
                                     std::uint32_t cut) {
  return {isThere ? offset * stride : 0, isThere ? stride : 0, isThere ? b : Real(0), cut};
}
// The lines along a row or column in which a particle is the last, the middle, the first.
template <class Real>
struct BendingLines {
  BendingLine<Real> asLast, asMiddle, asFirst;
};
template <class Real>
INLINE BendingLines<Real> bendingLines(std::ptrdiff_t place, std::ptrdiff_t count, std::ptrdiff_t stride,
                                       Real b, std::array<std::uint32_t, 3> cuts) {
  return {bendingLine(place >= 2, -1, stride, b, cuts[0]),
          bendingLine(place >= 1 && place + 1 < count, 0, stride, b, cuts[1]),
          bendingLine(place + 2 < count, 1, stride, b, cuts[2])};
}
// What they add to the diagonal block of particle i; `middle` becomes the stiffness of the one around it.
template <class Real>
INLINE Real bendingBlock(const BendingLines<Real>& lines, const Real* w, std::ptrdiff_t i, std::uint32_t cut,
                         Real& middle) {
  const auto stiffness = [&](const BendingLine<Real>& line) __attribute__((always_inline)) {
    const Real whole = lineStiffness(w, i + line.offset, line.stride, line.stiffness);
    return (cut & line.cut) == 0 ? whole : Real(0);
  };
  middle = stiffness(lines.asMiddle);
  return (stiffness(lines.asLast) + Real(4) * middle) + stiffness(lines.asFirst);
}

template <bool hasCuts, class Real>
INLINE void addBendingBlocks(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const StepParams<Real>& step = pass.step;
  const Range all = rangeOf(step, row);
  const auto columns = static_cast<std::ptrdiff_t>(step.columns);
  const Real* w = pass.inverseMasses;
  const std::uint32_t* cutMasks = pass.cutMasks;
  const SymmetricArrays<Real> blocks = arraysOf(arguments.own.factors);
  Real *keptAlongRow = arguments.own.elements.bendAlongRow.data(),
       *keptAlongColumn = arguments.own.elements.bendAlongColumn.data();
  const Real alongRow = isBorder(row, step.rows) ? Real(0.5) * step.bendAlongRow : step.bendAlongRow;
  // Of particles that are alike in the place that they have in the row.
  const auto addAlike = [&](Range alike) __attribute__((always_inline)) {
    const std::ptrdiff_t place = alike.begin - all.begin;
    const BendingLines<Real> ofRow =
        bendingLines(place, columns, 1, alongRow, {BENDING_LEFT, BENDING_ROW, BENDING_RIGHT});
    const BendingLines<Real> ofColumn =
        bendingLines(std::ptrdiff_t{row}, static_cast<std::ptrdiff_t>(step.rows), columns,
                     isBorder(place, step.columns) ? Real(0.5) * step.bendAlongColumn : step.bendAlongColumn,
                     {BENDING_UPPER, BENDING_COLUMN, BENDING_LOWER});
#pragma GCC ivdep
    for (std::ptrdiff_t i = alike.begin; i < alike.end; ++i) {
      std::uint32_t cut = 0;
      if constexpr (hasCuts) cut = cutMasks[i];
      Real middleOfRow, middleOfColumn;
      const Real b =
          bendingBlock(ofRow, w, i, cut, middleOfRow) + bendingBlock(ofColumn, w, i, cut, middleOfColumn);
      keptAlongRow[i] = middleOfRow;
      keptAlongColumn[i] = middleOfColumn;
      addTo(blocks, i, Symmetric<Real>{{b, b, b}, {}});
    }
  };
  const std::ptrdiff_t inside = std::min(all.begin + 2, all.end), outside = std::max(inside, all.end - 2);
  const auto alikeFrom = [&](std::ptrdiff_t begin) {
    return Range{begin, begin == inside && inside < outside ? outside : begin + 1};
  };
  for (Range alike = alikeFrom(all.begin); alike.begin < all.end; alike = alikeFrom(alike.end))
    addAlike(alike);
}

template <class Real>
INLINE void linearizeRow(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(pass.step, row);
  const bool wind = pass.step.hasWind != 0;
  const Real *diagonal = own.diagonal.data(), *w = pass.inverseMasses;
  const SymmetricArrays<Real> air = arraysOf(own.air), factors = arraysOf(own.factors);
#pragma GCC ivdep
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Real a = diagonal[i];
    Symmetric<Real> block{{a, a, a}, {}};
    if (wind) block = block + at(air, i);
    put(factors, i, block);
  }
  if (pass.step.isMesh != 0) {
    linearizeMembranes(arguments, row);
    addMeshBlocks(arguments, row);
  } else {
    own.elements.clear(all.begin, all.end);
    const auto addBlocks = [&]<bool hasCuts>() __attribute__((always_inline)) {
      addSpringBlocks<hasCuts>(arguments, row);
      if (pass.step.hasMaterial != 0) addBendingBlocks<hasCuts>(arguments, row);
    };
    pass.cutMasks != nullptr ? addBlocks.template operator()<true>() : addBlocks.template operator()<false>();
  }
  if (hasSeams(pass)) addSeamBlocks(arguments, row);
  const Arrays<Real> displacements = arraysOf(own.displacements), residuals = arraysOf(own.residuals),
                     rightHandSide = arraysOf(own.rightHandSide), forces = arraysOf(pass.forces),
                     increments = arraysOf(own.increments);
  const auto putResiduals = [&]<bool hasAir>() __attribute__((always_inline)) {
#pragma GCC ivdep
    for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
      const Vec3<Real> d = at(displacements, i);
      Vec3<Real> residual = at(rightHandSide, i) - diagonal[i] * d;
      if constexpr (hasAir) residual = residual - at(air, i) * d;
      put(residuals, i, residual + at(forces, i));
    }
  };
  wind ? putResiduals.template operator()<true>() : putResiduals.template operator()<false>();
  const bool contacts = hasContacts(arguments);
  if (contacts || !own.touching.pairs.empty())
    for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
      Vec3<Real> residual = at(residuals, i);
      Symmetric<Real> block = at(factors, i);
      addPairs(own.touching, i, residual, block);
      if (contacts) addContact(arguments, i, residual, block);
      put(residuals, i, residual);
      put(own.factors, i, block);
    }
#pragma GCC ivdep
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const bool pinned = w[i] == Real(0);
    const Vec3<Real> zero{};
    put(residuals, i, selected(pinned, zero, canonical(at(residuals, i))));
    put(increments, i, zero);
    const Factors<Real> f = factorize(at(factors, i));
    put(factors, i, {selected(pinned, zero, f.inverse), selected(pinned, zero, f.lower)});
  }
}

template <class Real>
INLINE void multiplyRow(const ImplicitArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(pass.step, row);
  const Vec3<Real> zero{};
  const Arrays<Real> products = arraysOf(own.products), directions = arraysOf(own.directions.positions);
  const SymmetricArrays<Real> air = arraysOf(own.air);
  const Real *stiffness = own.diagonal.data(), *w = pass.inverseMasses;
  if (pass.step.isMesh != 0) {
    for (std::ptrdiff_t i = all.begin; i < all.end; ++i) put(products, i, zero);
    addMeshProducts(arguments, row);
  } else {
    multiplyElements(arguments, row, rows);
  }
  if (hasSeams(pass)) addSeamProducts(arguments, row);
  if (!own.touching.pairs.empty())
    for (std::ptrdiff_t i = all.begin; i < all.end; ++i)
      put(products, i, at(products, i) - forceOfPairs(own.touching, i));
  const auto finish = [&](auto addBlocks) __attribute__((always_inline)) {
#pragma GCC ivdep
    for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
      const Vec3<Real> p = at(directions, i), product = addBlocks(stiffness[i] * p, p, i);
      put(products, i, selected(w[i] == Real(0), zero, canonical(product - at(products, i))));
    }
  };
  const auto withBlocks = [](const SymmetricArrays<Real>& blocks) {
    return [=](Vec3<Real> sum, Vec3<Real> p, std::ptrdiff_t i) { return sum + at(blocks, i) * p; };
  };
  const auto addAir = withBlocks(air);
  const auto addPlanes = withBlocks(arraysOf(own.planes.blocks));
  const bool wind = pass.step.hasWind != 0;
  if (hasContacts(arguments))
    wind ? finish([=](Vec3<Real> sum, Vec3<Real> p, std::ptrdiff_t i) {
      return addPlanes(addAir(sum, p, i), p, i);
    })
         : finish(addPlanes);
  else
    wind ? finish(addAir) : finish([](Vec3<Real> sum, Vec3<Real>, std::ptrdiff_t) { return sum; });
}

template <class Real>
INLINE void updateDirectionRow(const ImplicitArguments<Real>& arguments, int row) {
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(arguments.step.step, row);
  const Arrays<Real> directions = arraysOf(own.directions.positions), corrections = arraysOf(own.corrections);
  const Real kept = own.scalars.kept;
  const bool isFirst = kept == Real(0);  // then what lies there belongs to another Newton step
#pragma GCC ivdep
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> last = selected(isFirst, Vec3<Real>{}, at(directions, i));
    put(directions, i, canonical(at(corrections, i) + kept * last));
  }
}

template <class Real>
INLINE void updateSolutionRow(const ImplicitArguments<Real>& arguments, int row) {
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(arguments.step.step, row);
  const Arrays<Real> directions = arraysOf(own.directions.positions), products = arraysOf(own.products),
                     increments = arraysOf(own.increments), residuals = arraysOf(own.residuals);
  const Real stepSize = own.scalars.stepSize;
#pragma GCC ivdep
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    put(increments, i, canonical(at(increments, i) + stepSize * at(directions, i)));
    put(residuals, i, canonical(at(residuals, i) - stepSize * at(products, i)));
  }
}

template <class Real>
INLINE void stopAtPlanesRow(const ImplicitArguments<Real>& arguments, int row) {
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(arguments.step.step, row);
  const Arrays<Real> increments = arraysOf(own.increments);
  const Real* w = arguments.step.inverseMasses;
#pragma GCC ivdep
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> e = at(increments, i),
                     stopped = canonical(stoppedAtPlane(own.planes, i, at(own.displacements, i), e));
    put(increments, i, selected(w[i] == Real(0), e, stopped));
  }
}

template <class Real>
INLINE void acceptRow(const ImplicitArguments<Real>& arguments, int row) {
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(arguments.step.step, row);
  const Arrays<Real> displacements = arraysOf(own.displacements), increments = arraysOf(own.increments),
                     places = arraysOf(own.iterate.positions);
  const Arrays<const Real> starts = arraysOf(arguments.step.before.positions);
  const Real length = own.scalars.newtonLength;
#pragma GCC ivdep
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> displacement = canonical(at(displacements, i) + length * at(increments, i));
    put(displacements, i, displacement);
    put(places, i, canonical(at(starts, i) + displacement));
  }
}

}  // namespace

VECTOR_CLONES(void, linearize, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              linearizeRow(arguments, row))
void linearize(const ImplicitArguments<double>& arguments, int row) { linearizeRow(arguments, row); }
VECTOR_CLONES(void, multiply, (const ImplicitArguments<float>& arguments, int row, ForceRows<float>& rows),
              (arguments, row, rows), multiplyRow(arguments, row, rows))
void multiply(const ImplicitArguments<double>& arguments, int row, ForceRows<double>& rows) {
  multiplyRow(arguments, row, rows);
}
VECTOR_CLONES(void, updateDirection, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              updateDirectionRow(arguments, row))
void updateDirection(const ImplicitArguments<double>& arguments, int row) {
  updateDirectionRow(arguments, row);
}
VECTOR_CLONES(void, updateSolution, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              updateSolutionRow(arguments, row))
void updateSolution(const ImplicitArguments<double>& arguments, int row) {
  updateSolutionRow(arguments, row);
}
VECTOR_CLONES(void, stopAtPlanes, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              stopAtPlanesRow(arguments, row))
void stopAtPlanes(const ImplicitArguments<double>& arguments, int row) { stopAtPlanesRow(arguments, row); }
VECTOR_CLONES(void, tryLengths, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              tryLengthsRow(arguments, row))
void tryLengths(const ImplicitArguments<double>& arguments, int row) { tryLengthsRow(arguments, row); }
VECTOR_CLONES(void, accept, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              acceptRow(arguments, row))
void accept(const ImplicitArguments<double>& arguments, int row) { acceptRow(arguments, row); }

}  // namespace clothsim::cpu
