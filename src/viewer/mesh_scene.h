// Meshes that are opened in the viewer: as a cloth in a scene of its own, or as a solid in the scene that is
// open.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace clothsim {

// A piece of cotton with the shape of an OBJ file falls over a ball onto the ground. Files whose mesh would
// be larger than 20 m are taken to be in centimetres or millimetres. @throws SceneError as meshShapeOf()
[[nodiscard]] Scene sceneOfMesh(const std::filesystem::path& file);

// The same scene with the mesh as a collider, its middle at `place` [m]. @throws SceneError as meshShapeOf();
// whether it is closed shows when the scene is used
[[nodiscard]] Scene withMeshSolid(Scene scene, const std::filesystem::path& file, Vec3d place);

}  // namespace clothsim
