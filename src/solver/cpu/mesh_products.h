// H times the directions for meshes, as far as hinges and membranes go; the twin of meshProducts() in
// shaders/sim/implicit/mesh.glsl, with the same sums in the same order. There a particle works out all that
// it is a corner of. Here each hinge and triangle is worked out once for a stretch of particles, many at a
// time, and particles gather what it does to them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/mesh_lists.h"

namespace clothsim::cpu {

template <class Real>
struct ImplicitArguments;

// The hinges and membranes that the particles of a stretch (MESH_ROW of them, solver/cpu/rows.h) are corners
// of, stretch after stretch. One that reaches into several is in each.
template <class Real>
struct MeshStretches {
  struct Stretch {
    std::uint32_t firstParticle, firstHinge, firstMembrane;
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
  std::uint32_t mostFours = 0;   // vectors that a stretch comes to: one a hinge, three a membrane

  // Of membranes at the iterate, by component.
  std::array<std::vector<Real>, 9> edges;     // [m]
  std::array<std::vector<Real>, 3> tensions;  // over the lengths of the edges [N/m]
};

template <class Real>
[[nodiscard]] MeshStretches<Real> makeMeshStretches(const Cloth& cloth, const MeshLists<Real>& lists);

// The edges and tensions of a stretch.
void linearizeMembranes(const ImplicitArguments<float>& arguments, int row);
void linearizeMembranes(const ImplicitArguments<double>& arguments, int row);
// Adds to the products of a stretch of particles, which springs have begun.
void addElementProducts(const ImplicitArguments<float>& arguments, int row);
void addElementProducts(const ImplicitArguments<double>& arguments, int row);

}  // namespace clothsim::cpu
