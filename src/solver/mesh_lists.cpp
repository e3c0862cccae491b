#include "solver/mesh_lists.h"

#include <optional>

#include "core/exact_math.h"
#include "solver/step_params.h"

namespace clothsim {
namespace {

constexpr double NEVER_TOO_LONG = 1e15;  // [m]; its square is finite in binary32

template <class Real>
Real startLength(const Cloth& cloth, std::uint32_t a, std::uint32_t b) {
  const Vec3<Real> d = startPosition<Real>(cloth, b) - startPosition<Real>(cloth, a);
  const Real lengthSquared = dot(d, d);
  return lengthSquared * inverseSquareRoot(lengthSquared);
}

template <class Real>
void addSeams(const Cloth& cloth, MeshLists<Real>& lists) {
  if (cloth.seams().empty()) return;
  std::vector<std::vector<typename MeshLists<Real>::SeamSpringAt>> at(cloth.particleCount());
  for (const auto& [a, b, seam, stiffness] : cloth.seams()) {
    const Real length = startLength<Real>(cloth, a, b), k = static_cast<Real>(stiffness);
    at[a].push_back({b, seam, k, length});
    at[b].push_back({a, seam, k, length});
  }
  for (const auto& own : at) {
    lists.seamStarts.push_back(static_cast<std::uint32_t>(lists.seamSprings.size()));
    lists.seamSprings.insert(lists.seamSprings.end(), own.begin(), own.end());
  }
  lists.seamStarts.push_back(static_cast<std::uint32_t>(lists.seamSprings.size()));
}

template <class Real>
Real restLengthOf(const Cloth& cloth, const MeshSpring& spring) {
  const auto scale = static_cast<Real>(cloth.pieces()[cloth.pieceOf(spring.a)].restScale);
  return scale * startLength<Real>(cloth, spring.a, spring.b);
}

template <class Real>
auto membraneParamsOf(const Cloth& cloth, const Membrane& membrane) {
  typename MeshLists<Real>::MembraneParams params{membrane.corners, {}, {}};
  const auto scale = static_cast<Real>(cloth.pieces()[cloth.pieceOf(membrane.corners[0])].restScale);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3<Real> edge = startPosition<Real>(cloth, membrane.corners[(k + 2) % 3]) -
                            startPosition<Real>(cloth, membrane.corners[(k + 1) % 3]);
    params.restSquared[k] = (scale * scale) * dot(edge, edge);
  }
  for (std::size_t n = 0; n < membrane.roots.size(); ++n)
    params.roots[n] = static_cast<Real>(membrane.roots[n]);
  return params;
}

}  // namespace

template <class Real>
MeshLists<Real> makeMeshLists(const Cloth& cloth, const Cuts& cuts) {
  MeshLists<Real> result;
  addSeams(cloth, result);
  if (!cloth.hasMesh()) return result;
  std::optional<SpringLists> left;
  if (!cuts.empty()) left = remainingLists(cloth, cuts);
  const SpringLists& lists = left ? *left : cloth.lists();
  const auto hingeNumbers = static_cast<std::uint32_t>(lists.hingesOf.entries.size()),
             others = hingeNumbers + static_cast<std::uint32_t>(lists.trianglesOf.entries.size());
  for (std::size_t i = 0; i <= cloth.particleCount(); ++i)
    result.starts.push_back({lists.springsOf.starts[i], lists.hingesOf.starts[i],
                             hingeNumbers + lists.trianglesOf.starts[i],
                             others + lists.membranesOf.starts[i]});
  for (const MeshSpring& spring : lists.springs)
    result.limited.push_back(
        {spring.a, spring.b,
         isCut(cuts, cloth, spring) ? static_cast<Real>(NEVER_TOO_LONG) : restLengthOf<Real>(cloth, spring),
         0});
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3<Real> place = startPosition<Real>(cloth, i);
    result.places.push_back({place.x, place.y, place.z, 0});
    for (std::uint32_t at = lists.springsOf.starts[i]; at < lists.springsOf.starts[i + 1]; ++at) {
      const std::uint32_t number = lists.springsOf.entries[at];
      const MeshSpring& spring = lists.springs[number];
      const std::uint32_t kind = spring.kind == SpringKind::structural ? STRUCTURAL_SPRING : 0u;
      result.springs.push_back({spring.a == i ? spring.b : spring.a, number | kind,
                                static_cast<Real>(spring.stiffness), result.limited[number].restLength});
    }
  }
  result.numbers = lists.hingesOf.entries;
  for (const auto* incidence : {&lists.trianglesOf, &lists.membranesOf})
    result.numbers.insert(result.numbers.end(), incidence->entries.begin(), incidence->entries.end());
  for (const Membrane& membrane : lists.membranes)
    result.membranes.push_back(membraneParamsOf<Real>(cloth, membrane));
  for (const Hinge& hinge : lists.hinges) {
    const auto& c = hinge.coefficients;
    const auto real = [](double x) { return static_cast<Real>(x); };
    result.hinges.push_back({hinge.corners, {real(c[0]), real(c[1]), real(c[2]), real(c[3])}});
  }
  for (const auto& [a, b, c] : lists.triangles) result.triangles.push_back({a, b, c, 0});
  return result;
}

template MeshLists<float> makeMeshLists(const Cloth&, const Cuts&);
template MeshLists<double> makeMeshLists(const Cloth&, const Cuts&);

}  // namespace clothsim
