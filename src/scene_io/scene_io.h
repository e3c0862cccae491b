// Reads and writes scenes as JSON, and finds the bundled ones. Every mistake of the user becomes a SceneError
// that names the file, the line or JSON path, what was found, what was expected, and the nearest known key.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

// Reads a scene from JSON text; `source` names it in messages. Every key must be known, apart from comments:
// keys named "comment" or beginning with "//", at any place, with any value; they are not saved again.
// @throws SceneError
[[nodiscard]] Scene parseScene(std::string_view text, const std::string& source);

// Mesh files that lie beside `file`, from which the scene was read, get their full path; others are looked
// for below the resource root.
void findMeshes(Scene& scene, const std::filesystem::path& file);

// Reads a scene file. @throws SceneError (also for a missing or unreadable file: what the user named is not a
// scene)
[[nodiscard]] Scene loadScene(const std::filesystem::path& path);

// Loads what the flag -f names: a mesh if it ends in ".obj" (scene_io/mesh_scene.h), a path if it has a '/'
// or ends in ".json", else a bundled scene. @throws SceneError
[[nodiscard]] Scene loadSceneByName(const std::string& nameOrPath);

// JSON text that parseScene turns into an equal scene. Keys at their defaults are left out.
[[nodiscard]] std::string formatScene(const Scene& scene);

// Writes formatScene(scene) whole or not at all. @throws InputOutputError
void saveScene(const Scene& scene, const std::filesystem::path& path);

// `--set key=value`: the key is a path such as "solver.integrator" or "cloth.ks" ("cloth.x" is "cloths.0.x");
// the value is JSON, or a bare word taken as a string; null takes a key back to its default, or an entry out
// of its list. "sphere.x" and "plane.x" are those of the first collider of that type. Checks ranges as the
// reader does, and leaves the scene as it was when something is wrong. Messages name `flag` as where it came
// from. With the scene's first material solver.integrator, solver.simulation_steps and a kind of
// solver.self_collision go back to their defaults. @throws SceneError, UsageError (no '=')
void setSceneValue(Scene& scene, const std::string& keyEqualsValue, const std::string& flag = "--set");

struct BundledScene {
  std::string name, description;
  std::filesystem::path path, thumbnail;  // of the scene; of its picture, a PNG, which may be missing
};
[[nodiscard]] std::vector<std::string> bundledNames();    // sorted; no file is read for them
[[nodiscard]] std::vector<BundledScene> bundledScenes();  // by name

// The names of the files in the folder that look like scenes: JSON with a cloth that is no recording. Files
// that cannot be read are passed over.
[[nodiscard]] std::vector<std::string> sceneFilesIn(const std::filesystem::path& folder);

// `--resolution`: every grid gets columns x rows points; pins keep their place on the cloth, total mass and
// spring constants stay. In scenes with `ks` thickness follows the smaller spacing. Unless `keepSteps`,
// simulation_steps is multiplied by what an explicit step then needs (the ceiling of the spacing ratio; to
// the power 3/2 with stiffness_reference, whose k grows with 1/L). Returns a sentence for stderr, empty when
// nothing but the grid changed.
// @throws UsageError for sides outside 2 to 16384, more than 2^26 particles, or a grid on which two pin
// motions would meet in one point
[[nodiscard]] std::string changeResolution(Scene& scene, int columns, int rows, bool keepSteps);
// The same for cloths whose numbers of points alone have been edited: what else depends on them follows.
// `before` is the scene before the edit. @throws UsageError as changeResolution() for pin motions
void followGrids(Scene& edited, const Scene& before);

}  // namespace clothsim
