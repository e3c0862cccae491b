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
    std::uint32_t firstParticle, firstVertex, firstHinge, firstMembrane, firstSpring, firstWatched;
    bool hasStiffSprings;
  };
  std::vector<Stretch> stretches;  // by ascending particles, and one that ends the last
  // The particles that a stretch and its elements have to do with, its own first; what follows knows them by
  // their place there.
  std::vector<std::uint32_t> vertices;
  // By component, for loops over many elements.
  std::array<std::vector<std::uint32_t>, 4> hingeCorners;
  std::array<std::vector<Real>, 3> coefficients;  // of the corners behind the first
  std::array<std::vector<std::uint32_t>, 3> membraneCorners;
  std::array<std::vector<Real>, 3> restSquared;
  std::array<std::vector<Real>, 6> roots;
  // What acts on particle i, [elementStarts[i], elementStarts[i + 1]): hinges, then membranes, as places
  // among the vectors that the stretch's elements come to, those of hinges before those of membranes, where
  // the forces on all first corners come before those on all second ones; and what they count there.
  struct ElementAt {
    std::uint32_t place;
    Real coefficient;
  };
  std::vector<std::uint32_t> elementStarts;
  std::vector<ElementAt> elementsAt;
  // Vectors that a stretch comes to: one a vertex, a hinge and a spring, three a membrane.
  std::uint32_t mostFours = 0;

  // By place in MeshLists::springs; empty if no spring is stiff.
  std::vector<std::uint32_t> ends, others;
  std::vector<Real> stiffnesses, restLengths;
  // Every spring once, at its owner, the end of the larger number: whether it is too long.
  std::vector<std::uint32_t> watchedEnds, watchedOthers;
  std::vector<Real> watchedLengths;  // at rest [m]

  [[nodiscard]] std::size_t membraneCount() const { return restSquared[0].size(); }
};

template <class Real>
[[nodiscard]] MeshStretches<Real> makeMeshStretches(const Cloth& cloth, const MeshLists<Real>& lists);

}  // namespace clothsim::cpu
