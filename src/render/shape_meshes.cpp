#include "render/shape_meshes.h"

#include <span>

#include "render/look.h"
#include "shared/render_layout.h"

namespace clothsim {
namespace {

glm::vec3 glmOf(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

}  // namespace

ShapeMoment momentOf(const Collider& collider, double time) {
  const auto* mesh = std::get_if<MeshCollider>(&collider);
  return mesh != nullptr ? mesh->momentAt(mesh->progressAt(time)) : ShapeMoment{};
}

ShapeMeshes::ShapeMeshes() : vertices_("shapes") {}

void ShapeMeshes::build(const ColliderSet& colliders, double longestEdge) {
  std::vector<Surface::Vertex> points;
  std::vector<std::uint32_t> indices;
  parts_.clear();
  longestEdge_ = longestEdge;
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const Surface surface = colliders.drawnSurface(i, longestEdge);
    if (surface.indices.empty()) continue;
    parts_.push_back({indices.size(), surface.indices.size(), i, points.size(), momentOf(colliders[i], 0)});
    for (const std::uint32_t index : surface.indices)
      indices.push_back(index + static_cast<std::uint32_t>(points.size()));
    points.insert(points.end(), surface.vertices.begin(), surface.vertices.end());
  }
  if (parts_.empty()) return;
  points_ = gl::Buffer<Surface::Vertex>("shape points", std::span<const Surface::Vertex>(points));
  indices_ = gl::Buffer<std::uint32_t>("shape indices", std::span<const std::uint32_t>(indices));
  if (instances_.size() != parts_.size()) instances_ = gl::Buffer<Rows>("shape places", parts_.size());
  constexpr GLsizei stride = sizeof(Surface::Vertex);
  vertices_.attach(points_.name(), {.location = POSITION_LOCATION, .components = 3, .stride = stride});
  vertices_.attach(points_.name(), {.location = NORMAL_LOCATION,
                                    .components = 3,
                                    .stride = stride,
                                    .offset = offsetof(Surface::Vertex, normal)});
  vertices_.attachIndices(indices_.name());
  for (GLuint row = 0; row < 3; ++row)
    vertices_.attach(instances_.name(), {.location = INSTANCE_ROWS_LOCATION + row,
                                         .stride = sizeof(Rows),
                                         .offset = row * 16,
                                         .perInstance = true});
  vertices_.attach(instances_.name(), {.location = INSTANCE_COLLIDER_LOCATION,
                                       .components = 1,
                                       .stride = sizeof(Rows),
                                       .offset = offsetof(Rows, collider),
                                       .perInstance = true});
  vertices_.attach(instances_.name(), {.location = INSTANCE_LOOK_LOCATION,
                                       .stride = sizeof(Rows),
                                       .offset = offsetof(Rows, look),
                                       .perInstance = true});
}

void ShapeMeshes::reshape(Part& part, const ColliderSet& colliders, double time) {
  const ShapeMoment moment = momentOf(colliders[part.collider], time);
  if (moment == part.moment) return;
  points_.upload(colliders.drawnSurface(part.collider, longestEdge_, time).vertices, part.firstPoint);
  part.moment = moment;
}

void ShapeMeshes::place(const ColliderSet& colliders, double time) {
  std::vector<Rows> rows;
  for (Part& part : parts_) {
    const Vec3d place = poseAt(colliders[part.collider], time).position;
    const Matrix3 r = colliders.rotationAt(part.collider, time);
    const auto row = [&](Vec3d axis, double along) {
      return glm::vec4(glmOf(axis.x, axis.y, axis.z), static_cast<float>(along));
    };
    rows.push_back({row(r[0], place.x), row(r[1], place.y), row(r[2], place.z),
                    glm::vec4(static_cast<float>(part.collider)), drawnLook(colliders[part.collider])});
    reshape(part, colliders, time);
  }
  if (!rows.empty()) instances_.upload(rows);
}

void ShapeMeshes::draw() const {
  if (parts_.empty()) return;
  vertices_.bind();
  for (std::size_t i = 0; i < parts_.size(); ++i)
    glDrawElementsInstancedBaseInstance(
        GL_TRIANGLES, static_cast<GLsizei>(parts_[i].indexCount), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(parts_[i].firstIndex * sizeof(std::uint32_t)), 1,
        static_cast<GLuint>(i));
}

}  // namespace clothsim
