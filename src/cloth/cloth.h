// The cloth as built from a scene: particles, grids, meshes, springs and triangles. Immutable while stepping;
// what moves is in solver/state.h. Several cloths lie in the same arrays, each a contiguous range of
// particles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "cloth/seams.h"
#include "cloth/spring_lists.h"
#include "core/vec.h"
#include "scene/scene.h"

namespace clothsim {

// The six springs a grid point owns, each to a point with a smaller index. The order is that of the spring
// numbers: spring = 6 * particle + slot. Every particle gathers its springs in ascending number.
enum SpringSlot : int {
  toLeft,
  toUpper,
  toUpperLeft,
  toUpperRight,
  toSecondLeft,
  toSecondUpper,
  SPRING_SLOTS
};

struct SpringOffset {
  int columns, rows;  // from the owner to the other end
  SpringKind kind;
};
inline constexpr std::array<SpringOffset, SPRING_SLOTS> springOffsets{{{-1, 0, SpringKind::structural},
                                                                       {0, -1, SpringKind::structural},
                                                                       {-1, -1, SpringKind::shear},
                                                                       {1, -1, SpringKind::shear},
                                                                       {-2, 0, SpringKind::bending},
                                                                       {0, -2, SpringKind::bending}}};

// The twelve springs at a grid point in ascending number: the six it owns, then those owned by points with
// larger indices.
struct IncidentSpring {
  int columns, rows;  // from the particle to the other end
  SpringSlot slot;
  bool owned;  // by the particle itself
};
inline constexpr std::array<IncidentSpring, 2 * SPRING_SLOTS> incidentSprings{{{-1, 0, toLeft, true},
                                                                               {0, -1, toUpper, true},
                                                                               {-1, -1, toUpperLeft, true},
                                                                               {1, -1, toUpperRight, true},
                                                                               {-2, 0, toSecondLeft, true},
                                                                               {0, -2, toSecondUpper, true},
                                                                               {1, 0, toLeft, false},
                                                                               {2, 0, toSecondLeft, false},
                                                                               {-1, 1, toUpperRight, false},
                                                                               {0, 1, toUpper, false},
                                                                               {1, 1, toUpperLeft, false},
                                                                               {0, 2, toSecondUpper, false}}};

// The triangles at a grid point in ascending number (Cloth::triangles()), corners as (columns, rows) from the
// point.
struct Corner {
  int columns, rows;
};
inline constexpr std::array<std::array<Corner, 3>, 6> incidentTriangles{{{{{0, -1}, {-1, 0}, {0, 0}}},
                                                                         {{{0, -1}, {0, 0}, {1, -1}}},
                                                                         {{{1, -1}, {0, 0}, {1, 0}}},
                                                                         {{{-1, 0}, {-1, 1}, {0, 0}}},
                                                                         {{{0, 0}, {-1, 1}, {0, 1}}},
                                                                         {{{0, 0}, {0, 1}, {1, 0}}}}};

// One grid of particles, row-major, column fastest. A mesh is a grid of one row, whose springs and triangles
// come from Cloth::lists(): whatever treats each particle alone need not know.
struct Piece {
  std::uint32_t firstParticle = 0;
  int columns = 0, rows = 0;
  bool rowsGoUp = false;    // a standing sheet: row 0 is its bottom, and its front faces +z
  double particleMass = 0;  // of a particle inside; a mesh: their mean [kg]
  std::array<bool, SPRING_SLOTS> slotEnabled{};      // and long enough to lie on the grid
  std::array<double, SPRING_SLOTS> stiffness{};      // of a spring inside; a mesh: of its stiffest [N/m]
  std::array<double, SPRING_SLOTS> nominalLength{};  // [m], of the undisturbed lattice
  // The material model: what lies on a border counts half (masses at corners a quarter), and bending has the
  // energy 1/2 b |x(i-1) - 2 x(i) + x(i+1)|^2 a particle and direction instead of springs.
  bool hasMaterial = false;
  double bendAlongRow = 0, bendAlongColumn = 0;  // b [N/m]
  double restScale = 1;  // rest lengths over those as it is made; part of nominalLength already
  // Of CS184's model: some spring of a kind starts by more than 1e-6 m off nominal, and rests as it starts.
  bool hasRestLengthTable = false;

  // Of a mesh alone; nominalLength is the mean edge for all slots then, none of which is enabled.
  bool isMesh = false;
  std::vector<SpringColor> colors;                   // of its springs
  std::uint32_t firstTriangle = 0, endTriangle = 0;  // in Cloth::lists()
  double longestEdge = 0;                            // [m]
  std::array<double, 2> textureSize{};               // of a unit of u and of v, on average [m]

  [[nodiscard]] std::uint32_t particleCount() const {
    return static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows);
  }
  [[nodiscard]] std::uint32_t particle(int column, int row) const {
    return firstParticle + static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns) +
           static_cast<std::uint32_t>(column);
  }
  // The two triangles of a cell, counterclockwise seen from the front.
  [[nodiscard]] std::array<std::array<std::uint32_t, 3>, 2> cellTriangles(int column, int row) const {
    const std::uint32_t a = particle(column, row), b = particle(column + 1, row);
    const std::uint32_t c = particle(column, row + 1), d = particle(column + 1, row + 1);
    if (rowsGoUp) return {{{a, b, c}, {b, d, c}}};
    return {{{a, c, b}, {b, c, d}}};
  }
  // Of the material model: 1/2 for springs in `slot` along a border, else 1.
  [[nodiscard]] double springWeight(int column, int row, SpringSlot slot) const {
    const bool onBorder = (slot == toLeft && (row == 0 || row == rows - 1)) ||
                          (slot == toUpper && (column == 0 || column == columns - 1));
    return hasMaterial && onBorder ? 0.5 : 1;
  }
  // Of the material model: 1/2 for particles on a border, 1/4 at corners, else 1.
  [[nodiscard]] double massWeight(int column, int row) const {
    if (!hasMaterial) return 1;
    return (column == 0 || column == columns - 1 ? 0.5 : 1) * (row == 0 || row == rows - 1 ? 0.5 : 1);
  }
  [[nodiscard]] double stiffestSpring() const {  // [N/m]
    double stiffest = 0;
    for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
      if (slotEnabled[slot] || isMesh) stiffest = std::max(stiffest, stiffness[slot]);
    return stiffest;
  }
  [[nodiscard]] bool contains(int column, int row) const {
    return column >= 0 && column < columns && row >= 0 && row < rows;
  }
};

// How many particles, or rows of a grid, a thread takes at once: some 10 us of work.
inline constexpr int ROW_PARTICLES_AT_ONCE = 512;
[[nodiscard]] inline std::uint32_t rowsAtOnce(const Piece& piece) {
  return static_cast<std::uint32_t>(1 + (ROW_PARTICLES_AT_ONCE - 1) / piece.columns);
}

struct Spring {
  // Of a grid 6 * owner + slot; of a mesh its place in Cloth::lists(), behind all those.
  std::uint32_t number;
  SpringKind kind;
  std::uint32_t a, b;  // owner, other end
  double stiffness, restLength;
};

class Cloth;
// Where parts of a texture meet on a mesh, a point has other texture coordinates in one triangle than in the
// next: of triangles that have others than Cloth::textureCoordinates() those of their corners.
using TextureSeams = std::map<std::array<std::uint32_t, 3>, std::array<std::array<float, 2>, 3>>;

// The smallest distance of two neighbours at rest, on grids and meshes; 0 for particles without any [m].
[[nodiscard]] double smallestSpacing(const Cloth& cloth);

class Cloth {
 public:
  // @throws SceneError when the cloths hold more particles than 2^26 or than memory has room for, or a mesh
  // or the pins on it are wrong
  explicit Cloth(const Scene& scene);

  [[nodiscard]] std::uint32_t particleCount() const { return static_cast<std::uint32_t>(positions_.size()); }
  [[nodiscard]] std::span<const Piece> pieces() const { return pieces_; }
  [[nodiscard]] std::size_t pieceOf(std::uint32_t particle) const;               // its place in pieces()
  [[nodiscard]] std::span<const Vec3d> positions() const { return positions_; }  // at the start [m]
  [[nodiscard]] std::span<const double> inverseMasses() const { return inverseMasses_; }  // [1/kg], 0: pinned
  [[nodiscard]] bool hasRestLengthTable() const;                                          // of any grid
  // Of the spring of a grid in `slot`, or of a mesh, that joins two particles of the piece [m].
  [[nodiscard]] double restLength(const Piece& piece, std::size_t slot, std::uint32_t a,
                                  std::uint32_t b) const;
  [[nodiscard]] double massOf(std::uint32_t particle) const;         // when it is not pinned [kg]
  [[nodiscard]] const SpringLists& lists() const { return lists_; }  // of all meshes
  [[nodiscard]] const std::vector<SeamSpring>& seams() const { return seams_; }
  [[nodiscard]] bool hasMesh() const { return !lists_.empty(); }
  [[nodiscard]] bool isOfMesh(std::uint32_t particle) const {
    return hasMesh() && pieces_[pieceOf(particle)].isMesh;
  }

  // Counter-clockwise seen from the front: +y of a horizontal sheet, +z of a standing one. Cell (c, r) has
  // triangles 2 q and 2 q + 1, q = r (columns - 1) + c: of its corners A B / C D they have A, B, C and B, C,
  // D. Of a mesh those of its file.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles() const;
  // 0 to 1, u along the columns and v downwards along the rows, which is from the last row to the first where
  // rowsGoUp; of a mesh those of its file.
  [[nodiscard]] std::vector<std::array<float, 2>> textureCoordinates() const;
  [[nodiscard]] const TextureSeams& textureSeams() const { return textureSeams_; }
  // All enabled springs in ascending number; for measuring and drawing, not used while stepping.
  [[nodiscard]] std::vector<Spring> springs() const;
  [[nodiscard]] std::uint64_t triangleCount() const;
  [[nodiscard]] std::uint64_t springCount() const;  // enabled ones

 private:
  std::vector<Piece> pieces_;
  std::vector<Vec3d> positions_;
  void addGrid(const ClothSettings& settings);
  void addMesh(const ClothSettings& settings);
  void checkSize(std::uint64_t more) const;
  void holdPins(const ClothSettings& settings, std::uint32_t first);

  std::vector<double> inverseMasses_;
  std::vector<double> meshMasses_;                     // by particle; empty without meshes
  std::vector<std::array<float, 2>> meshCoordinates_;  // the same
  TextureSeams textureSeams_;
  SpringLists lists_;
  std::vector<SeamSpring> seams_;
};

}  // namespace clothsim
