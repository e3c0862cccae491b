#include "render/colliders.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/look.h"
#include "scene/colliders/surface.h"

namespace clothsim {
namespace {

bool isHorizontal(const Plane& plane) { return std::abs(glm::normalize(toGlm(plane.normal)).y) > 0.95f; }

float groundRadius(const Stage& stage) {
  return static_cast<float>(STAGE_SIZES) * glm::length(stage.view.size());
}

// On which the scene stands.
bool isGround(const Collider& collider) {
  const auto* plane = std::get_if<Plane>(&collider);
  return plane != nullptr && isHorizontal(*plane) && plane->normal.y > 0 && !plane->render.color;
}

}  // namespace

void Colliders::build(const Scene& scene) {
  colliders_ = ColliderSet(scene);
  shapes_.build(colliders_, longestEdge_);
}

void Colliders::place(const Scene& scene, const Stage& stage, double time) {
  std::vector<SpherePlace> places;
  std::vector<PlaneDisc>& discs = discs_;
  discs.clear();
  solids_.clear();
  const glm::vec3 middle = stage.view.center();
  const float radius = groundRadius(stage);
  const auto addDisc = [&](glm::vec3 point, glm::vec3 normal, float collider, glm::vec4 look) {
    const glm::vec3 center = middle - glm::dot(middle - point, normal) * normal;
    discs.push_back({glm::vec4(center, radius), glm::vec4(normal, collider), look});
  };
  bool hasFloor = false;
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    const Collider& collider = colliders_[i];
    const auto number = static_cast<float>(i);
    const Pose pose = poseAt(collider, time);
    if (const auto* sphere = std::get_if<Sphere>(&collider)) {
      const double drawn = sphere->radius - sphereShrink(sphere->radius, longestEdge_);
      places.push_back({glm::vec4(toGlm(pose.position), static_cast<float>(drawn)), glm::vec4(number),
                        drawnLook(collider)});
    } else if (const auto* plane = std::get_if<Plane>(&collider)) {
      addDisc(toGlm(pose.position), glm::normalize(toGlm(rotate(pose.rotation, plane->normal))), number,
              drawnLook(collider));
      hasFloor = hasFloor || isHorizontal(*plane);
      continue;
    }
    const glm::vec3 at = toGlm(pose.position), half = toGlm(colliders_.halfExtent(i, pose.rotation));
    glm::mat3 rotation(1);
    if (!std::holds_alternative<Sphere>(collider))
      for (int row = 0; row < 3; ++row) rotation[row] = toGlm(pose.rotation[static_cast<std::size_t>(row)]);
    solids_.push_back({at, rotation, {at - half, at + half}, momentOf(collider, time)});
  }
  if (scene.render.ground && !hasFloor)
    addDisc({middle.x, stage.floorHeight, middle.z}, {0, 1, 0}, -1, drawnLook(Plane{}));
  spheres_.place(places);
  shapes_.place(colliders_, time);
  planes_.place(discs);
}

glm::vec4 groundPlace(const Scene& scene, const Stage& stage) {
  glm::vec3 middle = stage.view.center();
  const auto ground = std::find_if(scene.colliders.begin(), scene.colliders.end(), isGround);
  middle.y = ground == scene.colliders.end() ? stage.floorHeight : toGlm(poseAt(*ground, 0).position).y;
  return {middle, groundRadius(stage)};
}

bool hasGround(const Scene& scene) {
  return std::any_of(scene.colliders.begin(), scene.colliders.end(), isGround) ||
         (scene.render.ground &&
          std::none_of(scene.colliders.begin(), scene.colliders.end(), [](const Collider& collider) {
            const auto* plane = std::get_if<Plane>(&collider);
            return plane != nullptr && isHorizontal(*plane);
          }));
}

void Colliders::drawSolids(const gl::Program& sphere, const gl::Program& shape) const {
  sphere.bind();
  spheres_.draw();
  shape.bind();
  shapes_.draw();
}

void Colliders::drawPlanes(const gl::Program& plane) const {
  plane.bind();
  planes_.draw(0, discs_.size());
}

void Colliders::drawPlane(const gl::Program& plane, std::size_t number) const {
  plane.bind();
  planes_.draw(number, 1);
}

}  // namespace clothsim
