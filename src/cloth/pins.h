// Which particles of a cloth its pins hold, and which motion each of them follows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

[[nodiscard]] std::string pointText(GridPoint point);  // "[column, row]", for messages

// The block of points of a grid that a pin holds. The top of a vertical sheet is its last row.
[[nodiscard]] GridRange pointsOf(const Pin& pin, const ClothSettings& cloth);

// That names a point of a mesh as its file counts it.
[[nodiscard]] VertexPin vertexPinOf(const ClothSettings& cloth, std::uint32_t point);

// Whether the pin is one of meshes: a vertex, a region, a group or paint.
[[nodiscard]] bool isMeshPin(const Pin& pin);
// Whether a pin holds a particle, by particle, counted from the cloth's first one. @throws SceneError when
// its mesh cannot be read or does not have what a pin names, or when the pins overlap so often that going
// through them would take minutes
[[nodiscard]] std::vector<bool> pinnedParticles(const ClothSettings& cloth);

// How far `points` of a mesh name each of its particles, 0 to 1: vertices, regions and groups wholly, paint
// as far as the channel of the colour says. `key` is theirs, for messages. @throws SceneError as
// pinnedParticles
[[nodiscard]] std::vector<double> weightsOf(const std::vector<Pin>& points, const ClothSettings& cloth,
                                            const std::string& key);

// The pins that a motion moves: its own list, or all pins of the cloth where that is empty.
[[nodiscard]] const std::vector<Pin>& pinsOf(const PinMotion& motion, const ClothSettings& cloth);

inline constexpr int NO_MOTION = -1;  // a pin that stays, or a free point

// For each grid point, row-major, or vertex: the index in `pinMotion` of the motion that it follows, or
// NO_MOTION. In a cloth without conflicts (see below) every pin follows at most one. @throws SceneError as
// pinnedParticles
[[nodiscard]] std::vector<int> pinMotionOfPoints(const ClothSettings& cloth);

// Which keys of a motion are free; empty where none are.
[[nodiscard]] std::vector<bool> freeKeys(const PinMotion& motion);

// Which pins are held later only; empty where none are. @throws SceneError as pinnedParticles
[[nodiscard]] std::vector<bool> freeAtTheStart(const ClothSettings& cloth);

// The path of the centre of a motion's pins, whose mean start position is `center` [m].
[[nodiscard]] Motion pathAbout(const PinMotion& motion, Vec3d center);

// A point that a motion names although the cloth does not pin it, or although another motion moves it.
struct PinConflict {
  std::size_t motion, pin;                 // pinMotion[motion], the pin of that number in pinsOf()
  std::string point;                       // where, for messages
  std::optional<std::size_t> otherMotion;  // none: not pinned
};
// The first conflict of a cloth, whose pins must all lie on the grid. @throws SceneError as pinnedParticles
[[nodiscard]] std::optional<PinConflict> findPinConflict(const ClothSettings& cloth);

}  // namespace clothsim
