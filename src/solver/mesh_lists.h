// The lists of meshes (cloth/spring_lists.h) as both backends step with them: rounded once, with rest lengths
// measured by the step's own arithmetic, so that springs at rest exert no force at all. The layout for float
// is that of the buffers on the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "shared/mesh_lists.h"

namespace clothsim {

template <class Real>
struct MeshLists {
  struct Starts {  // of what a particle gathers over
    std::uint32_t springs, hinges, triangles, membranes;
  };
  struct SpringAt {
    std::uint32_t other;   // the other end
    std::uint32_t number;  // in SpringLists::springs, with STRUCTURAL_SPRING
    Real stiffness, restLength;
  };
  struct HingeParams {
    std::array<std::uint32_t, 4> corners;
    std::array<Real, 4> coefficients;
  };
  struct MembraneParams {
    std::array<std::uint32_t, 3> corners;
    std::array<Real, 3> restSquared;  // of the edges opposite them [m^2]
    std::array<Real, 6> roots;        // MembraneRoots
  };
  struct LimitedSpring {
    std::uint32_t a, b;
    Real restLength, unused;
  };

  std::vector<Starts> starts;  // one more than particles
  std::vector<SpringAt> springs;
  std::vector<std::uint32_t> numbers;  // of hinges, then of triangles, then of membranes
  std::vector<HingeParams> hinges;
  std::vector<MembraneParams> membranes;
  std::vector<std::array<std::uint32_t, 4>> triangles;
  std::vector<LimitedSpring> limited;       // by number
  std::vector<std::array<Real, 4>> places;  // where particles start [m]

  // Of seams, of grids, too; by particle, in the order of the scene. Empty without seams.
  struct SeamSpringAt {
    std::uint32_t other, seam;
    Real stiffness, startLength;
  };
  std::vector<std::uint32_t> seamStarts;  // one more than particles
  std::vector<SeamSpringAt> seamSprings;

  [[nodiscard]] bool empty() const { return starts.empty(); }
};

// Of what `cuts` have left: particles gather over that alone, and the strain limit finds no other spring too
// long. Without meshes it has none but the lists of seams.
template <class Real>
[[nodiscard]] MeshLists<Real> makeMeshLists(const Cloth& cloth, const Cuts& cuts = {});

}  // namespace clothsim
