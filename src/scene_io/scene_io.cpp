// Scenes in and out of files.
#include "scene_io/scene_io.h"

#include <algorithm>

#include "cloth/material.h"
#include "core/error.h"
#include "core/files.h"
#include "core/nearest.h"
#include "scene_io/mesh_scene.h"
#include "scene_io/scene_tree.h"

namespace clothsim {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largestFile = 16 * 1024 * 1024;

std::vector<std::string> jsonFilesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored))
    if (entry->path().extension() == ".json") names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path bundledFolder() { return resourceRoot() / "assets" / "scenes"; }

// The folder of the file, absolute unless the current folder no longer exists.
fs::path folderOf(const fs::path& file) {
  std::error_code code;
  const fs::path whole = fs::absolute(file, code);
  return (code ? file : whole).parent_path();
}

// A texture's path is relative to the scene; bundled ones have no extension.
void findTexture(Scene& scene, const fs::path& scenePath) {
  const auto find = [&](std::string& texture) {
    if (!isTexturePath(texture) || fs::path(texture).is_absolute()) return;
    texture = (folderOf(scenePath) / texture).lexically_normal().string();
  };
  find(scene.render.texture);
  for (ClothSettings& cloth : scene.cloths)
    if (cloth.render.texture) find(*cloth.render.texture);
}

bool isPath(const std::string& nameOrPath) {
  return nameOrPath.find('/') != std::string::npos || nameOrPath.ends_with(".json");
}

}  // namespace

void findMeshes(Scene& scene, const fs::path& file) {
  // `first`: the file itself, or the first of several.
  const auto find = [&](std::string& mesh, const std::string& first) {
    if (mesh.empty() || fs::path(mesh).is_absolute()) return;
    const fs::path folder = folderOf(file);
    std::error_code ignored;  // Reading the file will report it.
    if (fs::exists(folder / first, ignored)) mesh = (folder / mesh).lexically_normal().string();
  };
  for (Collider& collider : scene.colliders)
    if (auto* mesh = std::get_if<MeshCollider>(&collider)) find(mesh->file, mesh->fileOf(0));
  for (ClothSettings& cloth : scene.cloths) find(cloth.mesh, cloth.mesh);
}

Scene parseScene(std::string_view text, const std::string& source) {
  try {
    const JsonPointer root = parseJson(text);
    gatherLists(*root);
    return readScene(*root);
  } catch (const JsonComplaint& complaint) {
    throw SceneError(located(source, complaint));
  }
}

Scene loadScene(const fs::path& path) {
  std::error_code ignored;
  if (fs::symlink_status(path, ignored).type() == fs::file_type::not_found) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    throw SceneError(path.string() + ": no such file" +
                     didYouMean(path.filename().string(), jsonFilesIn(folder)));
  }
  std::string text;
  try {
    text = readFile(path, largestFile);
  } catch (const InputOutputError& error) {
    throw SceneError(error.what());
  }
  Scene scene = parseScene(text, path.string());
  findMeshes(scene, path);
  chooseCounts(scene);  // once more, since the counts of a mesh follow from its file
  findTexture(scene, path);
  return scene;
}

Scene loadSceneByName(const std::string& nameOrPath) {
  if (isMeshFile(nameOrPath)) return sceneOfMesh(nameOrPath);
  checkIsNoOtherMesh(nameOrPath);
  if (isPath(nameOrPath)) return loadScene(nameOrPath);
  const fs::path path = bundledFolder() / (nameOrPath + ".json");
  std::error_code ignored;
  if (fs::exists(path, ignored)) return loadScene(path);
  const std::vector<std::string> names = bundledNames();
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw SceneError("no bundled scene is called \"" + nameOrPath + "\"" + didYouMean(nameOrPath, names) +
                   "\nbundled scenes: " + list + "\na scene of your own is given by its path, such as ./" +
                   nameOrPath + ".json");
}

std::string formatScene(const Scene& scene) {
  const JsonPointer root = writeScene(scene);
  // A single cloth is written as in CS184's files.
  JsonNode& cloths = *root->find("cloths");
  if (cloths.children.size() == 1) {
    JsonPointer cloth = std::move(cloths.children.front());
    cloth->key = "cloth";
    cloth->parent = root.get();
    for (auto& member : root->children)
      if (member->key == "cloths") {
        member = std::move(cloth);
        break;
      }
  }
  return formatJson(*root);
}

void saveScene(const Scene& scene, const fs::path& path) { writeFileAtomically(path, formatScene(scene)); }

std::vector<std::string> bundledNames() {
  std::vector<std::string> names;
  for (const std::string& file : jsonFilesIn(bundledFolder()))
    names.push_back(fs::path(file).stem().string());
  return names;
}

std::vector<BundledScene> bundledScenes() {
  std::vector<BundledScene> scenes;
  for (const std::string& name : bundledNames()) {
    const fs::path path = bundledFolder() / (name + ".json");
    scenes.push_back({name, loadScene(path).description, path,
                      resourceRoot() / "assets" / "thumbnails" / (name + ".png")});
  }
  return scenes;
}

std::vector<std::string> sceneFilesIn(const fs::path& folder) {
  std::vector<std::string> names = jsonFilesIn(folder);
  std::erase_if(names, [&](const std::string& name) {
    try {
      const std::string text = readFile(folder / name, largestFile);
      const auto has = [&](const char* words) { return text.find(words) != std::string::npos; };
      return has("\"clothsim-recording/") || !(has("\"cloth\"") || has("\"cloths\""));
    } catch (const Error&) {
      return true;
    }
  });
  return names;
}

}  // namespace clothsim
