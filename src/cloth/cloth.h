// The cloth as built from a scene: particles, grids, springs and triangles. Immutable while stepping; what moves is in
// solver/state.h. Several cloths lie in the same arrays, each grid a contiguous range of particles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"
#include "scene/scene.h"

namespace clothsim {

// The six springs a grid point owns, each to a point with a smaller index. The order is that of the spring numbers:
// spring = 6 * particle + slot. Every particle gathers its springs in ascending number.
enum SpringSlot : int { toLeft, toUpper, toUpperLeft, toUpperRight, toSecondLeft, toSecondUpper, SPRING_SLOTS };

enum class SpringKind { structural, shear, bending };

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

// One grid of particles, row-major, column fastest.
struct Grid {
  std::uint32_t firstParticle = 0;
  int columns = 0, rows = 0;
  double particleMass = 0;                            // [kg]
  std::array<bool, SPRING_SLOTS> slotEnabled{};
  std::array<double, SPRING_SLOTS> stiffness{};       // [N/m]
  std::array<double, SPRING_SLOTS> nominalLength{};   // [m], of the undisturbed lattice
  bool hasRestLengthTable = false;                    // some spring of a kind differs from nominal by more than 1e-6 m
  double velocityKept = 1;                            // 1 - damping/100, a step

  [[nodiscard]] std::uint32_t particleCount() const {
    return static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows);
  }
  // Whether the slot's other end lies on the grid.
  [[nodiscard]] bool has(int column, int row, int slot) const {
    const int c = column + springOffsets[static_cast<std::size_t>(slot)].columns;
    const int r = row + springOffsets[static_cast<std::size_t>(slot)].rows;
    return c >= 0 && c < columns && r >= 0;
  }
};

struct Spring {
  std::uint32_t number;  // 6 * owner + slot
  std::uint32_t a, b;    // owner, other end
  double stiffness, restLength;
};

class Cloth {
 public:
  // @throws SceneError when the grids hold more particles than 2^26
  explicit Cloth(const Scene& scene);

  [[nodiscard]] std::uint32_t particleCount() const { return static_cast<std::uint32_t>(positions_.size()); }
  [[nodiscard]] std::span<const Grid> grids() const { return grids_; }
  [[nodiscard]] std::span<const Vec3f> positions() const { return positions_; }     // at rest, as binary32 stores them [m]
  [[nodiscard]] std::span<const float> inverseMasses() const { return inverseMasses_; }  // [1/kg], 0: pinned
  // 6 a particle, by spring number; empty when no grid needs it [m]
  [[nodiscard]] std::span<const float> restLengths() const { return restLengths_; }

  // Counter-clockwise seen from the front (+y of a horizontal sheet). Cell (c, r) has triangles 2 q and 2 q + 1,
  // q = r (columns - 1) + c: with its corners A B / C D they are (A, C, B) and (B, C, D).
  [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles() const;
  // u along columns, v along rows, 0 to 1.
  [[nodiscard]] std::vector<std::array<float, 2>> textureCoordinates() const;
  // All enabled springs in ascending number; for measuring and drawing, not used while stepping.
  [[nodiscard]] std::vector<Spring> springs() const;
  [[nodiscard]] std::uint64_t triangleCount() const;

 private:
  std::vector<Grid> grids_;
  std::vector<Vec3f> positions_;
  std::vector<float> inverseMasses_;
  std::vector<float> restLengths_;
};

}  // namespace clothsim
