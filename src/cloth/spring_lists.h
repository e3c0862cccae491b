// Springs, bending and triangles of meshes as lists, with what each particle gathers over. Particles of grids
// have empty lists: theirs follow from the lattice (cloth.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cloth/membrane.h"

namespace clothsim {

enum class SpringKind { structural, shear, bending };

// Of an edge the numbers of the triangles beside it, in SpringLists::triangles; on a border twice the one.
using TrianglesBeside = std::array<std::uint32_t, 2>;

struct MeshSpring {
  std::uint32_t a, b;  // b < a: the owner is the end with the larger index
  SpringKind kind;
  double stiffness;           // [N/m]; 0 along the edges of a membrane, where it only measures and limits
  TrianglesBeside triangles;  // of the edge that it goes along or across
};

// Four particles around an inner edge: its ends, and the corners opposite. Energy 1/2 |sum c_i x_i|^2, so
// that the force on x_i is -c_i sum c_j x_j; the c sum to 0.
struct Hinge {
  std::array<std::uint32_t, 4> corners;
  std::array<double, 4> coefficients;  // [sqrt(N/m)]
  TrianglesBeside triangles;
};

// A triangle that resists strain in its plane.
struct Membrane {
  std::array<std::uint32_t, 3> corners;
  MembraneRoots roots;
  std::uint32_t triangle;  // its number in SpringLists::triangles
};

// Springs [first, end) of which no two share a particle: for the strain limit, which works in place.
struct SpringColor {
  std::uint32_t first, end;
};

struct SpringLists {
  // Grid by grid, structural before bending, colour by colour; their place is their number.
  std::vector<MeshSpring> springs;
  std::vector<Hinge> hinges;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // as the file has them
  std::vector<Membrane> membranes;                      // the triangles of meshes of a material

  // What particle i gathers over, ascending: entries [starts[i], starts[i + 1]) of each list.
  struct Incidence {
    std::vector<std::uint32_t> starts, entries;
  };
  Incidence springsOf;    // numbers of springs
  Incidence hingesOf;     // 4 * number of the hinge + which of its corners
  Incidence trianglesOf;  // numbers of triangles
  Incidence membranesOf;  // 4 * number of the membrane + which of its corners

  [[nodiscard]] bool empty() const { return triangles.empty(); }
  // The number of the structural spring that joins two particles.
  [[nodiscard]] std::optional<std::uint32_t> edgeBetween(std::uint32_t i, std::uint32_t j) const;
  [[nodiscard]] bool joins(std::uint32_t i, std::uint32_t j) const { return edgeBetween(i, j).has_value(); }
};

// Fills the incidences, for `particles` particles.
void gatherIncidences(SpringLists& lists, std::uint32_t particles);

// Sorts springs[first, ...) by kind and into colours, each spring into the first colour that neither of its
// ends has; within a colour they keep their order.
[[nodiscard]] std::vector<SpringColor> colorSprings(std::vector<MeshSpring>& springs, std::size_t first,
                                                    std::uint32_t particles);

}  // namespace clothsim
