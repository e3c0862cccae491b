#include "solver/cpu/mesh_forces.h"

#include "core/exact_math.h"
#include "solver/cpu/force_laws.h"
#include "solver/cpu/membrane_laws.h"
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

// -c_i sum c_j (x_j - x_0): the differences are small, and the c sum to 0.
template <class Real>
Vec3<Real> addHinges(const PassArguments<Real>& arguments, std::uint32_t i, Vec3<Real> f) {
  const MeshLists<Real>& lists = arguments.lists;
  const Components<Real>& x = arguments.before.positions;
  for (std::uint32_t n = lists.starts[i].hinges; n < lists.starts[i + 1].hinges; ++n) {
    const auto& [corners, c] = lists.hinges[lists.numbers[n] / 4];
    const Vec3<Real> origin = at(x, corners[0]);
    const Vec3<Real> b = c[1] * (at(x, corners[1]) - origin);
    const Vec3<Real> p = c[2] * (at(x, corners[2]) - origin);
    const Vec3<Real> q = c[3] * (at(x, corners[3]) - origin);
    const Vec3<Real> bent = (b + p) + q;
    f = f - c[lists.numbers[n] % 4] * bent;
  }
  return f;
}

template <class Real>
Vec3<Real> addMembranes(const PassArguments<Real>& arguments, std::uint32_t i, Vec3<Real> f) {
  const MeshLists<Real>& lists = arguments.lists;
  for (std::uint32_t n = lists.starts[i].membranes; n < lists.starts[i + 1].membranes; ++n) {
    const auto& [corners, restSquared, roots] = lists.membranes[lists.numbers[n] / 4];
    std::array<Vec3<Real>, 3> d = edgesOf(corners, arguments.before.positions);
    const OfEdges<Real> tensions = timesMatrix(roots, strainsOf(restSquared, d));
    for (std::size_t k = 0; k < 3; ++k) d[k] = tensions[k] * d[k];
    f = f + pullAt(lists.numbers[n] % 4, d);
  }
  return f;
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
void gather(const PassArguments<Real>& arguments, int row) {
  const Range particles = rangeOf(arguments.step, row);
  for (std::ptrdiff_t n = particles.begin; n < particles.end; ++n) {
    const auto i = static_cast<std::uint32_t>(n);
    Vec3<Real> f = addMembranes(arguments, i, addHinges(arguments, i, springsAt(arguments, i)));
    if (arguments.step.hasWind != 0)
      f = arguments.jet ? addTriangles<true>(arguments, i, f) : addTriangles<false>(arguments, i, f);
    arguments.forces.x[i] = f.x;
    arguments.forces.y[i] = f.y;
    arguments.forces.z[i] = f.z;
  }
}

}  // namespace

void gatherMeshForces(const PassArguments<float>& arguments, int row) { gather(arguments, row); }
void gatherMeshForces(const PassArguments<double>& arguments, int row) { gather(arguments, row); }

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
