// A scene as a JSON tree and back: the middle step of reading, writing and --set. For src/scene_io, and
// for readers of files that hold scenes among other things.
#pragma once

#include "scene/scene.h"
#include "scene_io/json_tree.h"

namespace clothsim {

// Moves CS184's `cloth`, `plane` and `sphere` objects into the lists `cloths` and `colliders`. The objects
// keep their parent, so that messages name them as the user wrote them. @throws JsonComplaint
void gatherLists(JsonNode& root);

// @throws JsonComplaint for everything that is wrong; `root` has been through gatherLists
[[nodiscard]] Scene readScene(const JsonNode& root);

// Both sides of each seam are lines of a grid, or points of a mesh, of a cloth that is there.
// @throws JsonComplaint
void checkSeams(const JsonNode& root, const Scene& scene);

// Always with the lists `cloths` and `colliders`; keys at their defaults are left out.
[[nodiscard]] JsonPointer writeScene(const Scene& scene);

}  // namespace clothsim
