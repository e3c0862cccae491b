#include "solver/cpu/mesh_stretches.h"

#include <algorithm>
#include <map>

#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

// What the particles [first, end) of a mesh are corners of.
template <class Real>
void addStretch(MeshStretches<Real>& result, const MeshLists<Real>& lists, std::uint32_t first,
                std::uint32_t end) {
  const auto firstHinge = static_cast<std::uint32_t>(result.coefficients[0].size()),
             firstMembrane = static_cast<std::uint32_t>(result.restSquared[0].size());
  const auto firstSpring = lists.springs.begin() + lists.starts[first].springs,
             endSpring = lists.springs.begin() + lists.starts[end].springs;
  result.stretches.push_back(
      {first, firstHinge, firstMembrane, lists.starts[first].springs,
       std::any_of(firstSpring, endSpring, [](const auto& spring) { return spring.stiffness != Real(0); })});
  std::map<std::uint32_t, std::uint32_t> own;  // of the stretch, by number
  for (std::uint32_t n = lists.starts[first].hinges; n < lists.starts[end].hinges; ++n)
    own[lists.numbers[n] / 4] = 0;
  for (auto& [number, place] : own) {
    const auto& hinge = lists.hinges[number];
    place = static_cast<std::uint32_t>(result.coefficients[0].size()) - firstHinge;
    for (std::size_t k = 0; k < 4; ++k)
      result.hingeCorners[k].push_back(static_cast<std::int32_t>(hinge.corners[k]));
    for (std::size_t k = 0; k < 3; ++k) result.coefficients[k].push_back(hinge.coefficients[k + 1]);
  }
  for (std::uint32_t n = lists.starts[first].hinges; n < lists.starts[end].hinges; ++n) {
    const std::uint32_t number = lists.numbers[n] / 4;
    result.hingesAt[n] = {own[number], lists.hinges[number].coefficients[lists.numbers[n] % 4]};
  }

  own.clear();
  for (std::uint32_t n = lists.starts[first].membranes; n < lists.starts[end].membranes; ++n)
    own[lists.numbers[n] / 4] = 0;
  for (auto& [number, place] : own) {
    const auto& membrane = lists.membranes[number];
    place = static_cast<std::uint32_t>(result.restSquared[0].size()) - firstMembrane;
    for (std::size_t k = 0; k < 3; ++k) {
      result.membraneCorners[k].push_back(static_cast<std::int32_t>(membrane.corners[k]));
      result.restSquared[k].push_back(membrane.restSquared[k]);
    }
    for (std::size_t k = 0; k < 6; ++k) result.roots[k].push_back(membrane.roots[k]);
  }
  const auto count = static_cast<std::uint32_t>(own.size());
  for (std::uint32_t n = lists.starts[first].membranes; n < lists.starts[end].membranes; ++n)
    result.forcesAt[n - result.firstForce] = lists.numbers[n] % 4 * count + own[lists.numbers[n] / 4];
}

template <class Real>
void addSprings(MeshStretches<Real>& result, const MeshLists<Real>& lists) {
  for (auto* numbers : {&result.ends, &result.others}) numbers->reserve(lists.springs.size());
  for (auto* values : {&result.stiffnesses, &result.restLengths}) values->reserve(lists.springs.size());
  for (std::size_t i = 0; i + 1 < lists.starts.size(); ++i)
    for (std::uint32_t n = lists.starts[i].springs; n < lists.starts[i + 1].springs; ++n) {
      result.ends.push_back(static_cast<std::int32_t>(i));
      result.others.push_back(static_cast<std::int32_t>(lists.springs[n].other));
      result.stiffnesses.push_back(lists.springs[n].stiffness);
      result.restLengths.push_back(lists.springs[n].restLength);
    }
}

}  // namespace

template <class Real>
MeshStretches<Real> makeMeshStretches(const Cloth& cloth, const MeshLists<Real>& lists) {
  MeshStretches<Real> result;
  if (lists.empty()) return result;
  result.firstForce = lists.starts.front().membranes;
  result.hingesAt.resize(lists.starts.front().triangles);
  result.forcesAt.resize(lists.numbers.size() - result.firstForce);
  for (const Piece& piece : cloth.pieces())
    for (int row = 0; piece.isMesh && row < rowsOf(piece); ++row) {
      const auto first = piece.firstParticle + static_cast<std::uint32_t>(MESH_ROW * row),
                 end = piece.firstParticle + static_cast<std::uint32_t>(piece.columns);
      addStretch(result, lists, first, std::min(first + MESH_ROW, end));
      const auto& stretch = result.stretches.back();
      const std::size_t hinges = result.coefficients[0].size() - stretch.firstHinge,
                        membranes = result.restSquared[0].size() - stretch.firstMembrane,
                        springs = lists.starts[std::min(first + MESH_ROW, end)].springs - stretch.firstSpring;
      result.mostFours =
          std::max(result.mostFours, static_cast<std::uint32_t>(hinges + 3 * membranes + springs));
    }
  result.stretches.push_back({static_cast<std::uint32_t>(cloth.particleCount()),
                              static_cast<std::uint32_t>(result.coefficients[0].size()),
                              static_cast<std::uint32_t>(result.restSquared[0].size()),
                              static_cast<std::uint32_t>(lists.springs.size()), false});
  addSprings(result, lists);
  const auto trim = [](auto& arrays) {
    for (auto& array : arrays) array.shrink_to_fit();
  };
  trim(result.hingeCorners), trim(result.coefficients), trim(result.membraneCorners),
      trim(result.restSquared), trim(result.roots);
  return result;
}
template MeshStretches<float> makeMeshStretches(const Cloth&, const MeshLists<float>&);
template MeshStretches<double> makeMeshStretches(const Cloth&, const MeshLists<double>&);

}  // namespace clothsim::cpu
