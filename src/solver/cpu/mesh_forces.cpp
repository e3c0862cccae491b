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

// Whether a spring, of those from `first` on, is too long for the watchdog.
template <class Real>
INLINE bool anyIsTooLong(const MeshStretches<Real>& mesh, const Real* vertices, Real maxStretch,
                         std::size_t first, std::size_t count) {
  const std::uint32_t *ends = mesh.watchedEnds.data() + first, *others = mesh.watchedOthers.data() + first;
  const Real* restLengths = mesh.watchedLengths.data() + first;
  std::uint32_t any = 0;
  SomeVertices<Real> from, to;
  for (std::size_t begin = 0; begin < count; begin += AT_ONCE) {
    const std::size_t some = std::min(AT_ONCE, count - begin);
    from.gather(vertices, ends + begin, some);
    to.gather(vertices, others + begin, some);
#pragma GCC ivdep
    for (std::size_t k = 0; k < some; ++k) {
      const Vec3<Real> d = to.at(k) - from.at(k);
      const Real longest = maxStretch * restLengths[begin + k];
      any |= isBeyond(dot(d, d), longest * longest) ? 1u : 0u;
    }
  }
  return any != 0;
}

// The forces of springs from `first` on.
template <class Real>
INLINE void pullSprings(const MeshStretches<Real>& mesh, const Real* vertices, std::size_t first,
                        std::size_t count, Real* forces) {
  const std::uint32_t *ends = mesh.ends.data() + first, *others = mesh.others.data() + first;
  const Real *stiffnesses = mesh.stiffnesses.data() + first, *restLengths = mesh.restLengths.data() + first;
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const Real *end = vertices + 4 * std::size_t{ends[k]}, *other = vertices + 4 * std::size_t{others[k]};
    putFour(forces, k,
            springForce(Vec3<Real>{end[0], end[1], end[2]}, Vec3<Real>{other[0], other[1], other[2]},
                        stiffnesses[k], restLengths[k]));
  }
}

template <class Real>
INLINE void pullMembranes(const MeshStretches<Real>& mesh, const Real* vertices, std::size_t first,
                          std::size_t count, Real* pulls) {
  forSomeMembranes(
      mesh, vertices, first, count,
      [&](std::size_t begin, std::size_t some, const SomeCorners<Real>& corners)
          __attribute__((always_inline)) {
            const auto rest = from(first + begin, mesh.restSquared);
            const auto roots = from(first + begin, mesh.roots);
#pragma GCC ivdep
            for (std::size_t k = 0; k < some; ++k) {
              const Edges<Real> d = corners.edgesAt(k);
              const OfEdges<Real> t =
                  timesMatrix(rootsAt(roots, k), strainsOf<Real>({rest[0][k], rest[1][k], rest[2][k]}, d));
              putPulls(pulls, count, begin + k, t[0] * d[0], t[1] * d[1], t[2] * d[2]);
            }
          });
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
  const std::uint32_t firstSpring = stretch->firstSpring, firstWatched = stretch->firstWatched;
  const ElementsOfStretch<Real> elements(*stretch, stretch[1], scratch);
  const Real* vertices = elements.vertices;
  putVertices(mesh, *stretch, stretch[1].firstVertex, arraysOf(std::as_const(arguments.before.positions)),
              elements.vertices);
  bendHinges(mesh, vertices, stretch->firstHinge, elements.hinges, elements.bent);
  pullMembranes(mesh, vertices, stretch->firstMembrane, elements.membranes, elements.pulls);
  if (stretch->hasStiffSprings) pullSprings(mesh, vertices, firstSpring, elements.springs, elements.forces);
  const bool tooLong = anyIsTooLong(mesh, vertices, arguments.step.maxStretch, firstWatched,
                                    stretch[1].firstWatched - firstWatched),
             oneByOne = tooLong || arguments.step.limitStiffness > Real(0);
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
