// Which points of a grid the pins of a cloth are, and which motion each of them follows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

[[nodiscard]] std::string pointText(GridPoint point);  // "[column, row]", for messages

// The block of points that a pin holds. The top of a vertical sheet is its last row.
[[nodiscard]] GridRange pointsOf(const Pin& pin, const ClothSettings& cloth);

// What `pinMotion[i].pinned` means: the cloth's own pins when it is empty.
[[nodiscard]] const std::vector<Pin>& pinsOf(const PinMotion& motion, const ClothSettings& cloth);

inline constexpr int NO_MOTION = -1;  // a pin that stays, or a free point

// For each grid point, row-major: the place in `pinMotion` of the motion that it follows, or NO_MOTION. In a
// cloth without conflicts (below) every pin follows at most one.
[[nodiscard]] std::vector<int> pinMotionOfPoints(const ClothSettings& cloth);

// A point that a motion names although the cloth does not pin it, or although another motion moves it.
struct PinConflict {
  std::size_t motion, pin;  // pinMotion[motion], the pin of that number in pinsOf()
  GridPoint point;
  std::optional<std::size_t> otherMotion;  // none: not pinned
};
// The first one; all pins must lie on the grid.
[[nodiscard]] std::optional<PinConflict> findPinConflict(const ClothSettings& cloth);

}  // namespace clothsim
