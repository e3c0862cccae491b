// Meshes in place of scene files: as a cloth in a scene of its own, or as a solid in another scene.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace clothsim {

// Whether a file is a mesh by its name.
[[nodiscard]] bool isMeshFile(const std::filesystem::path& file);
// @throws SceneError for meshes in formats that are not read
void checkIsNoOtherMesh(const std::filesystem::path& file);

// A piece of cotton with the shape of an OBJ file falls over a ball onto the ground. Files whose mesh would
// be larger than 20 m are taken to be in centimetres, or in millimetres where it is larger than 5 m then;
// the description says so. @throws SceneError as meshShapeOf()
[[nodiscard]] Scene sceneOfMesh(const std::filesystem::path& file);

// What it has done to the mesh: the unit that it takes for the file's, and where it puts it.
[[nodiscard]] std::string remarkOfMeshScene(const Scene& scene);

// The same scene with the mesh as a collider, its middle at `place` [m]. @throws SceneError as meshShapeOf();
// whether it is closed shows when the scene is used
[[nodiscard]] Scene withMeshSolid(Scene scene, const std::filesystem::path& file, Vec3d place);

}  // namespace clothsim
