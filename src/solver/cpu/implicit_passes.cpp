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

template <bool hasCuts, class Real>
INLINE void addSpringTrials(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Arrays<Real> x = arraysOf(own.iterate.positions), increments = arraysOf(own.increments);
  const std::array<Real*, LENGTHS_TRIED> trials{own.trials[0].data(), own.trials[1].data(),
                                                own.trials[2].data(), own.trials[3].data()};
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
              const bool isCut = isCutAt<hasCuts>(cutMasks, i, place.bit);
#pragma GCC unroll 4
              for (std::size_t k = 0; k < LENGTHS_TRIED; ++k) {
                const Real change = springChange(d, e, lengthTried<Real>(k), spring.stiffness, rest[i],
                                                 limitStiffness, limit);
                trials[k][i] = isCut ? trials[k][i] : trials[k][i] + change;
              }
            }
          });
}

// One line of three particles around the middle i: b (l k.dk + l^2/2 |dk|^2), k = (m - a) + (m - c).
template <class Real>
void addBendingTrial(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i, std::ptrdiff_t reach,
                     Real b) {
  ImplicitState<Real>& own = arguments.own;
  const Real* w = arguments.step.inverseMasses;
  const auto curvature = [&](const Components<Real>& c) {
    const Vec3<Real> m = at(c, i);
    return (m - at(c, i - reach)) + (m - at(c, i + reach));
  };
  const bool endOfClamp = w[i] == Real(0) && (w[i - reach] == Real(0)) != (w[i + reach] == Real(0));
  const Real weighted = endOfClamp ? Real(2) * b : b;
  const Vec3<Real> k = curvature(own.iterate.positions), dk = curvature(own.increments);
  const Real first = dot(k, dk), second = dot(dk, dk);
  for (std::size_t t = 0; t < LENGTHS_TRIED; ++t) {
    const Real l = lengthTried<Real>(t);
    Real& trial = own.trials[t][static_cast<std::size_t>(i)];
    trial = trial + (weighted * l) * (first + (Real(0.5) * l) * second);
  }
}

template <class Real>
void addBendingTrials(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const StepParams<Real>& step = pass.step;
  const Range all = rangeOf(step, row);
  const bool borderRow = isBorder(row, step.rows);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const std::uint32_t cut = pass.cutMasks != nullptr ? pass.cutMasks[i] : 0;
    const bool borderColumn = i == all.begin || i + 1 == all.end;
    if (!borderColumn && (cut & BENDING_ROW) == 0)
      addBendingTrial(arguments, i, 1, borderRow ? Real(0.5) * step.bendAlongRow : step.bendAlongRow);
    if (!borderRow && (cut & BENDING_COLUMN) == 0)
      addBendingTrial(arguments, i, indexOffset(step, 0, 1),
                      borderColumn ? Real(0.5) * step.bendAlongColumn : step.bendAlongColumn);
  }
}

template <class Real>
INLINE void tryLengthsRow(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(pass.step, row);
  const bool contacts = hasContacts(arguments);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> e = at(own.increments, i), d = at(own.displacements, i);
    Vec3<Real> force = own.diagonal.data()[i] * d, product = own.diagonal.data()[i] * e;
    if (pass.step.hasWind != 0) {
      force = force + at(own.air, i) * d;
      product = product + at(own.air, i) * e;
    }
    const Real first = dot(force - at(own.rightHandSide, i), e), second = Real(0.5) * dot(product, e);
    for (std::size_t k = 0; k < LENGTHS_TRIED; ++k) {
      const Real l = lengthTried<Real>(k);
      own.trials[k].data()[i] = l * (first + l * second);
    }
    addPairTrials(own, i, slowSlip(pass.step));
    if (!contacts) continue;
    const Vec3<Real> normal = at(own.planes.normals, i);
    const Real over = own.planes.offsets.data()[i] - dot(normal, d), fall = dot(normal, e),
               stiffness = contactStiffness(arguments, i), limit = own.planes.limits.data()[i],
               slow = slowSlip(pass.step);
    const Vec3<Real> slip = slipOf(own.planes, i, d), slide = e - fall * normal;
    const Real resisted = frictionPotential(slip, slow);
    const bool hasPlane = dot(normal, normal) > Real(0);
    for (std::size_t k = 0; k < LENGTHS_TRIED; ++k) {
      const Real l = lengthTried<Real>(k),
                 change = contactChange(stiffness, over, over - l * fall) +
                          limit * (frictionPotential(slip + l * slide, slow) - resisted);
      own.trials[k].data()[i] = hasPlane ? own.trials[k].data()[i] + change : own.trials[k].data()[i];
    }
  }
  if (hasSeams(pass)) addSeamTrials(arguments, row);
  if (pass.step.isMesh != 0) return addMeshTrials(arguments, row);
  pass.cutMasks != nullptr ? addSpringTrials<true>(arguments, row) : addSpringTrials<false>(arguments, row);
  if (pass.step.hasMaterial != 0) addBendingTrials(arguments, row);
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

// Bending stiffness of the line through particle `m`, by `stride` between its particles.
template <class Real>
Real lineStiffness(const Real* w, std::ptrdiff_t m, std::ptrdiff_t stride, Real b) {
  const bool endOfClamp = w[m] == Real(0) && (w[m - stride] == Real(0)) != (w[m + stride] == Real(0));
  return endOfClamp ? Real(2) * b : b;
}

// What bending along a row or column adds to the diagonal block of a particle, `place` in it; `middle`
// becomes the stiffness of the line whose middle it is.
template <class Real>
Real bendingBlock(const PassArguments<Real>& pass, std::ptrdiff_t i, std::ptrdiff_t place,
                  std::ptrdiff_t count, std::ptrdiff_t stride, Real b, std::uint32_t cut,
                  const std::uint32_t (&links)[3], Real& middle) {
  const Real* w = pass.inverseMasses;
  const bool isMiddle = place >= 1 && place + 1 < count && (cut & links[1]) == 0;
  middle = isMiddle ? lineStiffness(w, i, stride, b) : Real(0);
  Real sum = 0;
  if (place >= 2 && (cut & links[0]) == 0) sum = sum + lineStiffness(w, i - stride, stride, b);
  if (isMiddle) sum = sum + Real(4) * middle;
  if (place + 2 < count && (cut & links[2]) == 0) sum = sum + lineStiffness(w, i + stride, stride, b);
  return sum;
}

template <class Real>
void addBendingBlocks(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  const StepParams<Real>& step = pass.step;
  GridElements<Real>& elements = arguments.own.elements;
  const Range all = rangeOf(step, row);
  const bool borderRow = isBorder(row, step.rows);
  const auto columns = static_cast<std::ptrdiff_t>(step.columns),
             rows = static_cast<std::ptrdiff_t>(step.rows);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const std::uint32_t cut = pass.cutMasks != nullptr ? pass.cutMasks[i] : 0;
    const bool borderColumn = i == all.begin || i + 1 == all.end;
    const Real alongRow = borderRow ? Real(0.5) * step.bendAlongRow : step.bendAlongRow;
    const Real alongColumn = borderColumn ? Real(0.5) * step.bendAlongColumn : step.bendAlongColumn;
    const Real b =
        bendingBlock(pass, i, i - all.begin, columns, 1, alongRow, cut,
                     {BENDING_LEFT, BENDING_ROW, BENDING_RIGHT}, elements.bendAlongRow.data()[i]) +
        bendingBlock(pass, i, row, rows, columns, alongColumn, cut,
                     {BENDING_UPPER, BENDING_COLUMN, BENDING_LOWER}, elements.bendAlongColumn.data()[i]);
    addTo(arguments.own.factors, i, Symmetric<Real>{{b, b, b}, {}});
  }
}

template <class Real>
INLINE void linearizeRow(const ImplicitArguments<Real>& arguments, int row) {
  const PassArguments<Real>& pass = arguments.step;
  ImplicitState<Real>& own = arguments.own;
  const Range all = rangeOf(pass.step, row);
  const bool wind = pass.step.hasWind != 0, contacts = hasContacts(arguments);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Real a = own.diagonal.data()[i];
    Symmetric<Real> block{{a, a, a}, {}};
    if (wind) block = block + at(own.air, i);
    put(own.factors, i, block);
  }
  if (pass.step.isMesh != 0) {
    addMeshBlocks(arguments, row);
  } else {
    own.elements.clear(all.begin, all.end);
    pass.cutMasks != nullptr ? addSpringBlocks<true>(arguments, row) : addSpringBlocks<false>(arguments, row);
    if (pass.step.hasMaterial != 0) addBendingBlocks(arguments, row);
  }
  if (hasSeams(pass)) addSeamBlocks(arguments, row);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const bool pinned = pass.inverseMasses[i] == Real(0);
    const Vec3<Real> d = at(own.displacements, i), zero{};
    Vec3<Real> residual = at(own.rightHandSide, i) - own.diagonal.data()[i] * d;
    if (wind) residual = residual - at(own.air, i) * d;
    residual = residual + at(pass.forces, i);
    Symmetric<Real> block = at(own.factors, i);
    addPairs(own.touching, i, residual, block);
    if (contacts) addContact(arguments, i, residual, block);
    put(own.residuals, i, selected(pinned, zero, canonical(residual)));
    put(own.increments, i, zero);
    put(own.directions.positions, i, zero);
    const Factors<Real> factors = factorize(block);
    put(own.factors, i, {selected(pinned, zero, factors.inverse), selected(pinned, zero, factors.lower)});
  }
}

template <class Real>
INLINE void multiplyRow(const ImplicitArguments<Real>& arguments, int row) {
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
    multiplyElements(arguments, row);
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
#pragma GCC ivdep
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i)
    put(directions, i, canonical(at(corrections, i) + kept * at(directions, i)));
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
  const Real length = own.scalars.newtonLength;
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const Vec3<Real> displacement = canonical(at(own.displacements, i) + length * at(own.increments, i));
    put(own.displacements, i, displacement);
    put(own.iterate.positions, i, canonical(at(arguments.step.before.positions, i) + displacement));
  }
}

}  // namespace

VECTOR_CLONES(void, linearize, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              linearizeRow(arguments, row))
void linearize(const ImplicitArguments<double>& arguments, int row) { linearizeRow(arguments, row); }
VECTOR_CLONES(void, multiply, (const ImplicitArguments<float>& arguments, int row), (arguments, row),
              multiplyRow(arguments, row))
void multiply(const ImplicitArguments<double>& arguments, int row) { multiplyRow(arguments, row); }
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
