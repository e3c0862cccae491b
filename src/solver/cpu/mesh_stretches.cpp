#include "solver/cpu/mesh_stretches.h"

#include <algorithm>
#include <map>
#include <ranges>

#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

// Adds stretch after stretch.
template <class Real>
class StretchBuilder {
 public:
  StretchBuilder(const MeshLists<Real>& lists, MeshStretches<Real>& result)
      : lists_(lists),
        result_(result),
        anyIsStiff_(std::ranges::any_of(lists.springs,
                                        [](const auto& spring) { return spring.stiffness != Real(0); })) {}

  // What the particles [first, end) of a mesh are corners of.
  void add(std::uint32_t first, std::uint32_t end) {
    placeOf_.clear();
    begin(first, end);
    for (std::uint32_t i = first; i < end; ++i) (void)vertexOf(i);
    const Places hinges = addHinges(first, end), membranes = addMembranes(first, end);
    for (std::uint32_t i = first; i < end; ++i) addElementsAt(i, hinges, membranes);
    addSprings(first, end);
    const auto& stretch = result_.stretches.back();
    const std::size_t vertices = result_.vertices.size() - stretch.firstVertex,
                      springs = lists_.starts[end].springs - stretch.firstSpring,
                      fours = vertices + hinges.size() + 3 * membranes.size() + springs;
    result_.mostFours = std::max(result_.mostFours, static_cast<std::uint32_t>(fours));
  }
  // Particle `first` begins one; that of no particles ends the last.
  void begin(std::uint32_t first, std::uint32_t end) {
    const auto isStiff = [](const auto& spring) { return spring.stiffness != Real(0); };
    const auto firstSpring = lists_.springs.begin() + lists_.starts[first].springs,
               endSpring = lists_.springs.begin() + lists_.starts[end].springs;
    const auto sizeOf = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    result_.stretches.push_back({first, sizeOf(result_.vertices), sizeOf(result_.coefficients[0]),
                                 sizeOf(result_.restSquared[0]), lists_.starts[first].springs,
                                 sizeOf(result_.watchedLengths),
                                 std::any_of(firstSpring, endSpring, isStiff)});
  }

 private:
  std::uint32_t vertexOf(std::uint32_t particle) {
    const auto next =
        static_cast<std::uint32_t>(result_.vertices.size() - result_.stretches.back().firstVertex);
    const auto [known, isNew] = placeOf_.try_emplace(particle, next);
    if (isNew) result_.vertices.push_back(particle);
    return known->second;
  }

  using Places = std::map<std::uint32_t, std::uint32_t>;  // among those of the stretch, by number

  // Of the elements whose corners are the entries [first, end) of MeshLists::numbers.
  Places placesOf(std::uint32_t first, std::uint32_t end) const {
    Places places;
    for (std::uint32_t n = first; n < end; ++n) places[lists_.numbers[n] / 4] = 0;
    std::uint32_t next = 0;
    for (auto& [number, place] : places) place = next++;
    return places;
  }

  Places addHinges(std::uint32_t first, std::uint32_t end) {
    Places own = placesOf(lists_.starts[first].hinges, lists_.starts[end].hinges);
    for (const auto& [number, place] : own) {
      const auto& hinge = lists_.hinges[number];
      for (std::size_t k = 0; k < 4; ++k) result_.hingeCorners[k].push_back(vertexOf(hinge.corners[k]));
      for (std::size_t k = 0; k < 3; ++k) result_.coefficients[k].push_back(hinge.coefficients[k + 1]);
    }
    return own;
  }

  Places addMembranes(std::uint32_t first, std::uint32_t end) {
    Places own = placesOf(lists_.starts[first].membranes, lists_.starts[end].membranes);
    for (const auto& [number, place] : own) {
      const auto& membrane = lists_.membranes[number];
      for (std::size_t k = 0; k < 3; ++k) {
        result_.membraneCorners[k].push_back(vertexOf(membrane.corners[k]));
        result_.restSquared[k].push_back(membrane.restSquared[k]);
      }
      for (std::size_t k = 0; k < 6; ++k) result_.roots[k].push_back(membrane.roots[k]);
    }
    return own;
  }

  // A hinge pulls by minus its coefficient.
  void addElementsAt(std::uint32_t i, const Places& hinges, const Places& membranes) {
    result_.elementStarts[i] = static_cast<std::uint32_t>(result_.elementsAt.size());
    for (std::uint32_t n = lists_.starts[i].hinges; n < lists_.starts[i + 1].hinges; ++n) {
      const std::uint32_t number = lists_.numbers[n] / 4;
      result_.elementsAt.push_back(
          {hinges.at(number), -lists_.hinges[number].coefficients[lists_.numbers[n] % 4]});
    }
    const auto firstForce = static_cast<std::uint32_t>(hinges.size()),
               count = static_cast<std::uint32_t>(membranes.size());
    for (std::uint32_t n = lists_.starts[i].membranes; n < lists_.starts[i + 1].membranes; ++n)
      result_.elementsAt.push_back(
          {firstForce + lists_.numbers[n] % 4 * count + membranes.at(lists_.numbers[n] / 4), Real(1)});
    result_.elementStarts[i + 1] = static_cast<std::uint32_t>(result_.elementsAt.size());
  }

  void addSprings(std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t i = first; i < end; ++i)
      for (std::uint32_t n = lists_.starts[i].springs; n < lists_.starts[i + 1].springs; ++n) {
        const auto& spring = lists_.springs[n];
        const std::uint32_t own = vertexOf(i), other = vertexOf(spring.other);
        if (anyIsStiff_) {
          result_.ends.push_back(own);
          result_.others.push_back(other);
          result_.stiffnesses.push_back(spring.stiffness);
          result_.restLengths.push_back(spring.restLength);
        }
        if (spring.other > i) continue;
        result_.watchedEnds.push_back(own);
        result_.watchedOthers.push_back(other);
        result_.watchedLengths.push_back(spring.restLength);
      }
  }

  const MeshLists<Real>& lists_;
  MeshStretches<Real>& result_;
  bool anyIsStiff_;
  std::map<std::uint32_t, std::uint32_t> placeOf_;  // of a particle among the vertices of the stretch
};

}  // namespace

template <class Real>
MeshStretches<Real> makeMeshStretches(const Cloth& cloth, const MeshLists<Real>& lists) {
  MeshStretches<Real> result;
  if (lists.empty()) return result;
  result.elementStarts.resize(cloth.particleCount() + std::size_t{1});
  StretchBuilder<Real> builder(lists, result);
  for (const Piece& piece : cloth.pieces())
    for (int row = 0; piece.isMesh && row < rowsOf(piece); ++row) {
      const auto first = piece.firstParticle + static_cast<std::uint32_t>(MESH_ROW * row),
                 end = piece.firstParticle + static_cast<std::uint32_t>(piece.columns);
      builder.add(first, std::min(first + MESH_ROW, end));
    }
  builder.begin(cloth.particleCount(), cloth.particleCount());
  const auto trim = [](auto& arrays) {
    for (auto& array : arrays) array.shrink_to_fit();
  };
  result.elementsAt.shrink_to_fit();
  trim(result.hingeCorners), trim(result.coefficients), trim(result.membraneCorners),
      trim(result.restSquared), trim(result.roots);
  return result;
}
template MeshStretches<float> makeMeshStretches(const Cloth&, const MeshLists<float>&);
template MeshStretches<double> makeMeshStretches(const Cloth&, const MeshLists<double>&);

}  // namespace clothsim::cpu
