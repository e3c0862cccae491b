// Pins that the user moves and turns. The scene says where they go: each entry of a cloth's `pinned` gets a
// path of its own that is like that of a hand (solver/pin_paths.h), so that the pins go there at a hand's
// pace, also when the move is undone or the scene restarts. Its free key is so late that nobody sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cloth/cloth.h"
#include "core/shared.h"
#include "scene/rotation.h"
#include "scene/scene.h"

namespace clothsim {

// Pins of one cloth that are moved together.
struct PinGroup {
  std::size_t cloth = 0;  // in scene.cloths
  std::vector<Pin> pins;  // at least one; entries of its `pinned`, or single particles pinned by hand
  friend bool operator==(const PinGroup&, const PinGroup&) = default;
};

// The entry of `pinned` that holds the particle, or where there is none the particle alone. None where a path
// of the scene moves it, which is not one of hands.
[[nodiscard]] std::optional<PinGroup> pinGroupOf(const Scene& scene, const Cloth& cloth,
                                                 std::uint32_t particle);
// All pins of that cloth but those which a path of the scene moves.
[[nodiscard]] PinGroup wholePinGroup(const Scene& scene, std::size_t ofCloth);

// Where hands hold the pins of the group, or where they start: the centre of each entry [m].
[[nodiscard]] std::vector<Vec3d> placesOf(const PinGroup& group, const Scene& scene, const Cloth& cloth);
// Whether the scene holds all of the group by hands.
[[nodiscard]] bool isHeldByHands(const PinGroup& group, const Scene& scene);

// The scene in which hands hold the group, each pin where it is now. `positionOf` gives that of a particle
// [m].
[[nodiscard]] Scene withPinsHeld(Scene scene, const PinGroup& group, const Cloth& cloth,
                                 const std::function<Vec3d(std::uint32_t particle)>& positionOf);
// The scene in which the hands of the group, which all hold, have turned about `pivot` [m] and then gone on
// by `way` [m].
[[nodiscard]] Scene withPinsMoved(Scene scene, const PinGroup& group, const Cloth& cloth, Vec3d pivot,
                                  const Matrix3& turn, Vec3d way);

// The scene with the hands of another one that it lacks, which hold on: so undo does not leave pins on their
// way.
[[nodiscard]] Shared<Scene> withHandsOf(const Scene& other, const Shared<Scene>& scene);

}  // namespace clothsim
