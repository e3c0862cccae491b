#include "scene_io/mesh_scene.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "cloth/material.h"
#include "cloth/mesh_shape.h"
#include "core/error.h"
#include "core/formatted.h"
#include "scene_io/scene_io.h"

namespace clothsim {
namespace {

struct Unit {
  double scale;    // to metres
  double largest;  // what a mesh in this unit measures at most [m]
  const char* name;
};
constexpr std::array units{Unit{1, 20, "metres"}, Unit{0.01, 5, "centimetres"},
                           Unit{0.001, std::numeric_limits<double>::infinity(), "millimetres"}};

struct MeshBox {
  Vec3d low, high;  // in units of the file
  double scale = 1;
  std::string unit;

  [[nodiscard]] Vec3d size() const { return scale * (high - low); }          // [m]
  [[nodiscard]] Vec3d middle() const { return 0.5 * scale * (low + high); }  // [m]
};

MeshBox boxOf(const std::string& file) {
  constexpr double most = std::numeric_limits<double>::max();
  MeshBox box{{most, most, most}, {-most, -most, -most}, 1, ""};
  for (const Vec3d p : meshShapeOf(file)->points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  const Vec3d size = box.high - box.low;
  const double largest = std::max({size.x, size.y, size.z});
  const Unit* unit =
      std::ranges::find_if(units, [&](const Unit& u) { return u.scale * largest <= u.largest; });
  box.scale = unit->scale;
  box.unit = unit->name;
  return box;
}

std::string lowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

}  // namespace

bool isMeshFile(const std::filesystem::path& file) { return lowerExtension(file) == ".obj"; }

void checkIsNoOtherMesh(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 10> others{".ply",  ".glb", ".gltf", ".usd", ".usda",
                                                    ".usdc", ".fbx", ".stl",  ".abc", ".dae"};
  const std::string extension = lowerExtension(file);
  if (std::ranges::find(others, extension) == others.end()) return;
  throw SceneError(file.string() + ": expected a scene (.json) or a mesh as .obj, found " + extension +
                   "; meshes are read as .obj only: export this one as OBJ");
}

Scene sceneOfMesh(const std::filesystem::path& file) {
  const std::string whole = std::filesystem::absolute(file).string();
  const MeshBox box = boxOf(whole);
  const Vec3d size = box.size();
  const double radius = 0.18 * std::max({size.x, size.y, size.z});
  // As a file would say it, so that the solver's defaults are those of a scene with a material.
  Scene scene =
      parseScene(R"({"cloth": {"material": "cotton"}, "colliders": [{"type": "sphere"}, {"type": "plane"}]})",
                 file.string());
  scene.description = "A mesh as a piece of cotton, which falls over a ball. Its file is taken to be in " +
                      box.unit + ": \"scale\" of the cloth.";
  ClothSettings& cloth = scene.cloths[0];
  cloth.mesh = whole;
  cloth.scale = box.scale;
  // Its lowest point is a little above the ball.
  cloth.position = Vec3d{0, 2.1 * radius + 0.5 * size.y, 0} - box.middle();
  auto& ball = std::get<Sphere>(scene.colliders[0]);
  ball.origin = {0, radius, 0};
  ball.radius = radius;
  chooseCounts(scene);
  return scene;
}

std::string remarkOfMeshScene(const Scene& scene) {
  const ClothSettings& cloth = scene.cloths[0];
  return std::filesystem::path(cloth.mesh).filename().string() +
         formatted(": taken with cloth.scale=%g and moved by [%.4g, %.4g, %.4g] m, to above a ball",
                   cloth.scale, cloth.position.x, cloth.position.y, cloth.position.z);
}

Scene withMeshSolid(Scene scene, const std::filesystem::path& file, Vec3d place) {
  MeshCollider solid;
  solid.file = std::filesystem::absolute(file).string();
  const MeshBox box = boxOf(solid.file);
  solid.scale = box.scale;
  solid.origin = place - box.middle();
  scene.colliders.push_back(solid);
  return scene;
}

}  // namespace clothsim
