#include "viewer/mesh_scene.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "cloth/mesh_shape.h"
#include "scene_io/scene_io.h"

namespace clothsim {
namespace {

constexpr double largestInMetres = 20;

struct MeshBox {
  Vec3d low, high;  // in units of the file
  double scale = 1;

  [[nodiscard]] Vec3d size() const { return scale * (high - low); }          // [m]
  [[nodiscard]] Vec3d middle() const { return 0.5 * scale * (low + high); }  // [m]
};

MeshBox boxOf(const std::string& file) {
  constexpr double most = std::numeric_limits<double>::max();
  MeshBox box{{most, most, most}, {-most, -most, -most}};
  for (const Vec3d p : meshShapeOf(file)->points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  const Vec3d size = box.high - box.low;
  const double largest = std::max({size.x, size.y, size.z});
  for (const double unit : {0.01, 0.001})
    if (box.scale * largest > largestInMetres) box.scale = unit;
  return box;
}

}  // namespace

// As a file would say it, so that the solver's defaults are those of a scene with a material.
Scene sceneOfMesh(const std::filesystem::path& file) {
  const std::string whole = std::filesystem::absolute(file).string();
  const MeshBox box = boxOf(whole);
  const Vec3d size = box.size();
  const double radius = 0.18 * std::max({size.x, size.y, size.z});
  // Its lowest point is a little above the ball.
  const Vec3d position = Vec3d{0, 2.1 * radius + 0.5 * size.y, 0} - box.middle();
  const nlohmann::json scene{
      {"description", "A mesh as a piece of cotton, which falls over a ball."},
      {"cloth",
       {{"mesh", whole},
        {"scale", box.scale},
        {"position", {position.x, position.y, position.z}},
        {"material", "cotton"}}},
      {"colliders",
       {{{"type", "sphere"}, {"origin", {0, radius, 0}}, {"radius", radius}}, {{"type", "plane"}}}}};
  return parseScene(scene.dump(), file.string());
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
