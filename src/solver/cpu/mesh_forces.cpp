#include "solver/cpu/mesh_forces.h"

#include "core/exact_math.h"
#include "solver/cpu/force_laws.h"
#include "solver/cpu/membrane_laws.h"
#include "solver/cpu/mesh_elements.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/symmetric.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {
namespace {

template <class Real>
INLINE Vec3<Real> at(const Components<Real>& c, std::size_t i) {
  return {c.x[i], c.y[i], c.z[i]};
}

// Every spring is watched once, at its owner.
template <class Real>
Vec3<Real> springsAt(const PassArguments<Real>& arguments, std::uint32_t i) {
  const MeshLists<Real>& lists = arguments.lists;
  const Components<Real>& positions = arguments.before.positions;
  const Vec3<Real> x = at(positions, i);
  Vec3<Real> f{};
  bool overlong = false;
  for (std::uint32_t n = lists.starts[i].springs; n < lists.starts[i + 1].springs; ++n) {
    const auto& spring = lists.springs[n];
    const Vec3<Real> other = at(positions, spring.other);
    const Vec3<Real> d = other - x;
    const Real lengthSquared = dot(d, d);
    const Real longest = arguments.step.maxStretch * spring.restLength;
    const Real longestSquared = longest * longest;
    overlong = overlong || (spring.other < i && isBeyond(lengthSquared, longestSquared));
    if (spring.stiffness != Real(0)) f = f + springForce(x, other, spring.stiffness, spring.restLength);
    if (arguments.step.limitStiffness > Real(0)) {
      const Real inverseLength = inverseSquareRoot(lengthSquared);
      const Real over = lengthSquared * inverseLength - arguments.step.limitFactor * spring.restLength;
      const Real scale = (arguments.step.limitStiffness * over) * inverseLength;
      if (over > Real(0)) f = f + scale * d;
    }
  }
  if (overlong) noteDivergence(arguments.watch, PASS_FORCES, i, REASON_RUNAWAY_STRAIN);
  return f;
}

// The forces of springs from `first` on. Returns whether one is too long for the watchdog.
template <bool areStiff, class Real>
INLINE bool pullSprings(const MeshStretches<Real>& mesh, const Arrays<const Real>& x, Real maxStretch,
                        std::size_t first, std::size_t count, Real* forces) {
  const std::int32_t *ends = mesh.ends.data() + first, *others = mesh.others.data() + first;
  const Real *stiffnesses = mesh.stiffnesses.data() + first, *restLengths = mesh.restLengths.data() + first;
  std::uint32_t overlong = 0;
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3<Real> end = placeAt(x, ends[k]), other = placeAt(x, others[k]), d = other - end;
    const Real longest = maxStretch * restLengths[k];
    overlong |= isBeyond(dot(d, d), longest * longest) ? 1u : 0u;
    if constexpr (areStiff) putFour(forces, k, springForce(end, other, stiffnesses[k], restLengths[k]));
  }
  return overlong != 0;
}

template <class Real>
INLINE void pullMembranes(const MeshStretches<Real>& mesh, const Arrays<const Real>& x, std::size_t first,
                          std::size_t count, Real* pulls) {
  const auto corners = from(first, mesh.membraneCorners);
  const auto rest = from(first, mesh.restSquared);
  const auto roots = from(first, mesh.roots);
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const Edges<Real> d = edgesAt<Real>(corners, k, x);
    const OfEdges<Real> t =
        timesMatrix(rootsAt(roots, k), strainsOf<Real>({rest[0][k], rest[1][k], rest[2][k]}, d));
    putPulls(pulls, count, k, t[0] * d[0], t[1] * d[1], t[2] * d[2]);
  }
}

template <bool jet, class Real>
Vec3<Real> addTriangles(const PassArguments<Real>& arguments, std::uint32_t i, Vec3<Real> f,
                        Symmetric<Real>* resistance = nullptr) {
  const MeshLists<Real>& lists = arguments.lists;
  const auto& [x, v] = arguments.before;
  for (std::uint32_t n = lists.starts[i].triangles; n < lists.starts[i + 1].triangles; ++n) {
    const auto& [a, b, c, unused] = lists.triangles[lists.numbers[n]];
    const auto wind = windOn<jet>(arguments.step, arguments.interaction, at(x, a), at(x, b), at(x, c),
                                  at(v, a), at(v, b), at(v, c));
    f = f + wind.force;
    if (resistance != nullptr) *resistance = *resistance + outerProduct(wind.resistance, wind.normal);
  }
  return f;
}

template <class Real>
INLINE void gather(const PassArguments<Real>& arguments, int row, Real* scratch) {
  const MeshStretches<Real>& mesh = arguments.stretches;
  const auto stretch = stretchOf(arguments, row);
  const std::uint32_t firstSpring = stretch->firstSpring;
  const ElementsOfStretch<Real> elements(*stretch, stretch[1], scratch);
  const Arrays<const Real> x = arraysOf(std::as_const(arguments.before.positions));
  const Real maxStretch = arguments.step.maxStretch;
  bendHinges(mesh, x, stretch->firstHinge, elements.hinges, elements.bent);
  pullMembranes(mesh, x, stretch->firstMembrane, elements.membranes, elements.pulls);
  const bool overlong = stretch->hasStiffSprings ? pullSprings<true>(mesh, x, maxStretch, firstSpring,
                                                                     elements.springs, elements.forces)
                                                 : pullSprings<false>(mesh, x, maxStretch, firstSpring,
                                                                      elements.springs, elements.forces),
             oneByOne = overlong || arguments.step.limitStiffness > Real(0);
  const Range particles = rangeOf(arguments.step, row);
  for (std::ptrdiff_t n = particles.begin; n < particles.end; ++n) {
    const auto i = static_cast<std::uint32_t>(n);
    Four<Real> sum{};
    if (oneByOne)
      sum = fourOf(springsAt(arguments, i));
    else if (stretch->hasStiffSprings)
      for (std::uint32_t k = arguments.lists.starts[i].springs; k < arguments.lists.starts[i + 1].springs;
           ++k)
        if (mesh.stiffnesses[k] != Real(0)) sum = sum + vectorAt(elements.forces, k - firstSpring);
    Vec3<Real> f = threeOf(withElements(arguments, elements, n, sum));
    if (arguments.step.hasWind != 0)
      f = arguments.jet ? addTriangles<true>(arguments, i, f) : addTriangles<false>(arguments, i, f);
    put(arguments.forces, n, f);
  }
}

VECTOR_CLONES(void, gatherWithScratch, (const PassArguments<float>& arguments, int row, float* scratch),
              (arguments, row, scratch), gather(arguments, row, scratch))

}  // namespace

void gatherMeshForces(const PassArguments<float>& arguments, int row) {
  gatherWithScratch(arguments, row, scratchFor(arguments.stretches));
}
void gatherMeshForces(const PassArguments<double>& arguments, int row) {
  gather(arguments, row, scratchFor(arguments.stretches));
}

template <class Real>
void gatherMeshWind(const PassArguments<Real>& arguments, int row, SymmetricField<Real>& resistance) {
  const Range particles = rangeOf(arguments.step, row);
  for (std::ptrdiff_t n = particles.begin; n < particles.end; ++n) {
    const auto i = static_cast<std::uint32_t>(n);
    Symmetric<Real> sum{};
    const Vec3<Real> f = arguments.jet ? addTriangles<true>(arguments, i, Vec3<Real>{}, &sum)
                                       : addTriangles<false>(arguments, i, Vec3<Real>{}, &sum);
    arguments.forces.x[i] = f.x;
    arguments.forces.y[i] = f.y;
    arguments.forces.z[i] = f.z;
    put(resistance, n, sum);
  }
}
template void gatherMeshWind(const PassArguments<float>&, int, SymmetricField<float>&);
template void gatherMeshWind(const PassArguments<double>&, int, SymmetricField<double>&);

}  // namespace clothsim::cpu
