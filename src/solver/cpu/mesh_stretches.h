// The lists of meshes once more, as passes want them that work on many elements at a time: each hinge and
// triangle once for a stretch of particles, which then gather what it does to them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth/cloth.h"
#include "solver/mesh_lists.h"

namespace clothsim::cpu {

// Stretch after stretch, of MESH_ROW particles each (solver/cpu/rows.h): the hinges and membranes that they
// are corners of, also those that other stretches reach into, and their springs.
template <class Real>
struct MeshStretches {
  struct Stretch {
    std::uint32_t firstParticle, firstHinge, firstMembrane, firstSpring;
    bool hasStiffSprings;
  };
  std::vector<Stretch> stretches;  // by ascending particles, and one that ends the last
  // By component, for loops over many elements. Indices are signed: so they can be gathered by.
  std::array<std::vector<std::int32_t>, 4> hingeCorners;
  std::array<std::vector<Real>, 3> coefficients;  // of the corners behind the first
  std::array<std::vector<std::int32_t>, 3> membraneCorners;
  std::array<std::vector<Real>, 3> restSquared;
  std::array<std::vector<Real>, 6> roots;
  // By place in MeshLists::numbers: which hinge of the stretch, and the coefficient of the particle there;
  // from the first membrane on, which of the forces on corners, those on all first ones before all second
  // ones.
  struct HingeAt {
    std::uint32_t hinge;
    Real coefficient;
  };
  std::vector<HingeAt> hingesAt;
  std::vector<std::uint32_t> forcesAt;
  std::uint32_t firstForce = 0;  // the place in MeshLists::numbers of the first of these
  std::uint32_t mostFours = 0;  // vectors that a stretch comes to: one a hinge and a spring, three a membrane

  // By place in MeshLists::springs.
  std::vector<std::int32_t> ends, others;
  std::vector<Real> stiffnesses, restLengths;

  [[nodiscard]] std::size_t membraneCount() const { return restSquared[0].size(); }
};

template <class Real>
[[nodiscard]] MeshStretches<Real> makeMeshStretches(const Cloth& cloth, const MeshLists<Real>& lists);

}  // namespace clothsim::cpu
