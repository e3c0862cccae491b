// H times the directions for meshes, as far as hinges and membranes go; the twin of meshProducts() in
// shaders/sim/implicit/mesh.glsl, with the same sums in the same order. There a particle works out all that
// it is a corner of. Here each hinge and triangle is worked out once for a stretch of particles, many at a
// time, and particles gather what it does to them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace clothsim::cpu {

template <class Real>
struct ImplicitArguments;

// Of membranes at the iterate, by component, in the order of MeshStretches.
template <class Real>
struct MembraneTensions {
  std::array<std::vector<Real>, 9> edges;     // [m]
  std::array<std::vector<Real>, 3> tensions;  // over the lengths of the edges [N/m]

  void resize(std::size_t membranes);
};

// The edges and tensions of a stretch.
void linearizeMembranes(const ImplicitArguments<float>& arguments, int row);
void linearizeMembranes(const ImplicitArguments<double>& arguments, int row);
// Adds to the products of a stretch of particles, which springs have begun.
void addElementProducts(const ImplicitArguments<float>& arguments, int row);
void addElementProducts(const ImplicitArguments<double>& arguments, int row);

}  // namespace clothsim::cpu
