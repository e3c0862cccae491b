// Which particles the seams of a scene join.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"
#include "scene/scene.h"

namespace clothsim {

struct Piece;

struct SeamSpring {
  std::uint32_t a, b;  // of the sides `a` and `b` of the seam
  std::uint32_t seam;  // its place in Scene::seams
  double stiffness;    // [N/m]
};

// Two sides that are lines of grids are sewn along their lengths: each particle of the side that has more is
// joined to the one that lies as far along the other. Where a side is of a mesh, whose points have no order,
// each is joined to the nearest one at the start. No particle is joined to itself.
// @throws SceneError where a side names no points, or on a grid a block that is no line, or both sides name
// the same
[[nodiscard]] std::vector<SeamSpring> seamSprings(const Scene& scene, std::span<const Piece> pieces,
                                                  std::span<const Vec3d> positions);

// The part of their length at the start at which the springs of a seam rest at `time` [s].
[[nodiscard]] double seamLengthFactor(const Seam& seam, double time);

}  // namespace clothsim
