#include "solver/cpu/seam_passes.h"

#include "solver/cpu/arrays.h"
#include "solver/cpu/force_laws.h"
#include "solver/cpu/implicit_laws.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

template <class Real>
constexpr Real noLimitLength = static_cast<Real>(1e30f);  // no strain limit acts on seams

// Calls visit(i, spring, restLength) for the springs of the particles of a row.
template <class Real, class Visit>
void forEachSeam(const PassArguments<Real>& arguments, int row, Visit visit) {
  const MeshLists<Real>& lists = arguments.lists;
  const Range all = rangeOf(arguments.step, row);
  for (std::ptrdiff_t i = all.begin; i < all.end; ++i) {
    const auto place = static_cast<std::size_t>(i);
    for (std::uint32_t n = lists.seamStarts[place]; n < lists.seamStarts[place + 1]; ++n) {
      const auto& spring = lists.seamSprings[n];
      const Real restLength = arguments.step.seams[spring.seam].lengthFactor * spring.startLength;
      visit(i, spring, restLength);
    }
  }
}

// That of a spring, but where both ends are at one place, or are to be: there it is as stiff in all
// directions.
template <class Real>
SpringBlock<Real> seamBlock(Vec3<Real> d, Real stiffness, Real restLength, Real limitStiffness) {
  const Real lengthSquared = dot(d, d);
  const SpringBlock<Real> s = springBlock(d, stiffness, restLength, limitStiffness, noLimitLength<Real>);
  constexpr auto atOnePlace = static_cast<Real>(0x1p-60f);  // squared [m^2]
  if (restLength == Real(0) || lengthSquared < atOnePlace) return {stiffness, Real(0)};
  return s;
}

}  // namespace

template <class Real>
void addSeamForces(const PassArguments<Real>& arguments, int row) {
  const Components<Real>& x = arguments.before.positions;
  forEachSeam(arguments, row, [&](std::ptrdiff_t i, const auto& spring, Real restLength) {
    const Vec3<Real> force = springForce(at(x, i), at(x, spring.other), spring.stiffness, restLength);
    put(arguments.forces, i, at(arguments.forces, i) + force);
  });
}

template <class Real>
void addSeamBlocks(const ImplicitArguments<Real>& arguments, int row) {
  const Components<Real>& x = arguments.own.iterate.positions;
  forEachSeam(arguments.step, row, [&](std::ptrdiff_t i, const auto& spring, Real restLength) {
    const Vec3<Real> d = at(x, spring.other) - at(x, i);
    const auto [across, along] =
        seamBlock(d, spring.stiffness, restLength, arguments.step.step.limitStiffness);
    Symmetric<Real> k = outerProduct(along, d);
    k.diagonal = k.diagonal + Vec3<Real>{across, across, across};
    put(arguments.own.factors, i, at(arguments.own.factors, i) + k);
  });
}

template <class Real>
void addSeamProducts(const ImplicitArguments<Real>& arguments, int row) {
  const Components<Real>& x = arguments.own.iterate.positions;
  const Components<Real>& p = arguments.own.directions.positions;
  Components<Real>& products = arguments.own.products;
  forEachSeam(arguments.step, row, [&](std::ptrdiff_t i, const auto& spring, Real restLength) {
    const Vec3<Real> d = at(x, spring.other) - at(x, i), e = at(p, spring.other) - at(p, i);
    const auto [across, along] =
        seamBlock(d, spring.stiffness, restLength, arguments.step.step.limitStiffness);
    put(products, i, at(products, i) + (across * e + (along * dot(d, e)) * d));
  });
}

template <class Real>
void addSeamTrials(const ImplicitArguments<Real>& arguments, int row) {
  ImplicitState<Real>& own = arguments.own;
  const Components<Real>& x = own.iterate.positions;
  forEachSeam(arguments.step, row, [&](std::ptrdiff_t i, const auto& spring, Real restLength) {
    const auto place = static_cast<std::size_t>(i);
    if (spring.other > place) return;
    const Vec3<Real> d = at(x, spring.other) - at(x, i),
                     e = at(own.increments, spring.other) - at(own.increments, i);
    forEachLength(own, [&](Real* trial, Real l) {
      trial[place] = trial[place] + springChange(d, e, l, spring.stiffness, restLength,
                                                 arguments.step.step.limitStiffness, noLimitLength<Real>);
    });
  });
}

template void addSeamForces(const PassArguments<float>&, int);
template void addSeamForces(const PassArguments<double>&, int);
template void addSeamBlocks(const ImplicitArguments<float>&, int);
template void addSeamBlocks(const ImplicitArguments<double>&, int);
template void addSeamProducts(const ImplicitArguments<float>&, int);
template void addSeamProducts(const ImplicitArguments<double>&, int);
template void addSeamTrials(const ImplicitArguments<float>&, int);
template void addSeamTrials(const ImplicitArguments<double>&, int);

}  // namespace clothsim::cpu
