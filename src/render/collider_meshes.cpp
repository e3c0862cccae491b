#include "render/collider_meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "shared/render_layout.h"

namespace clothsim {
namespace {

std::vector<glm::vec3> spherePoints(int around, int down) {
  std::vector<glm::vec3> points;
  for (int row = 0; row <= down; ++row) {
    const double polar = std::numbers::pi * row / down;
    for (int column = 0; column < around; ++column) {
      const double azimuth = 2 * std::numbers::pi * column / around;
      points.emplace_back(static_cast<float>(std::sin(polar) * std::sin(azimuth)),
                          static_cast<float>(std::cos(polar)),
                          static_cast<float>(std::sin(polar) * std::cos(azimuth)));
    }
  }
  return points;
}

// Counter-clockwise from outside; the two triangles of a cell that touch a pole become one.
std::vector<std::uint32_t> sphereIndices(int around, int down) {
  std::vector<std::uint32_t> indices;
  const auto index = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * around + column % around);
  };
  for (int row = 0; row < down; ++row) {
    for (int column = 0; column < around; ++column) {
      const std::uint32_t a = index(row, column), b = index(row, column + 1);
      const std::uint32_t c = index(row + 1, column), d = index(row + 1, column + 1);
      if (row > 0) indices.insert(indices.end(), {a, c, b});
      if (row + 1 < down) indices.insert(indices.end(), {b, c, d});
    }
  }
  return indices;
}

// Instances change in number only when the scene is edited, in place every frame.
template <class T>
void uploadInstances(const char* label, gl::Buffer<T>& buffer, const std::vector<T>& instances) {
  if (buffer.size() != instances.size()) buffer = gl::Buffer<T>(label, instances.size());
  if (!instances.empty()) buffer.upload(instances);
}

}  // namespace

SphereMesh::SphereMesh(int around, int down)
    : points_("sphere points", spherePoints(around, down)),
      indices_("sphere indices", sphereIndices(around, down)),
      vertices_("spheres") {
  vertices_.attach(points_.name(),
                   {.location = POSITION_LOCATION, .components = 3, .stride = sizeof(glm::vec3)});
  vertices_.attachIndices(indices_.name());
}

void SphereMesh::place(const std::vector<SpherePlace>& spheres) {
  uploadInstances("sphere places", instances_, spheres);
  count_ = static_cast<GLsizei>(spheres.size());
  if (count_ == 0) return;
  constexpr GLsizei stride = sizeof(SpherePlace);
  vertices_.attach(instances_.name(),
                   {.location = INSTANCE_PLACE_LOCATION, .stride = stride, .perInstance = true});
  vertices_.attach(instances_.name(), {.location = INSTANCE_COLLIDER_LOCATION,
                                       .components = 1,
                                       .stride = stride,
                                       .offset = offsetof(SpherePlace, collider),
                                       .perInstance = true});
  vertices_.attach(instances_.name(), {.location = INSTANCE_LOOK_LOCATION,
                                       .stride = stride,
                                       .offset = offsetof(SpherePlace, look),
                                       .perInstance = true});
}

void SphereMesh::draw() const {
  if (count_ == 0) return;
  vertices_.bind();
  glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(indices_.size()), GL_UNSIGNED_INT, nullptr,
                          count_);
}

PlaneMesh::PlaneMesh() : vertices_("planes") {}

void PlaneMesh::place(const std::vector<PlaneDisc>& discs) {
  uploadInstances("plane discs", instances_, discs);
  if (discs.empty()) return;
  constexpr GLsizei stride = sizeof(PlaneDisc);
  vertices_.attach(instances_.name(),
                   {.location = INSTANCE_PLACE_LOCATION, .stride = stride, .perInstance = true});
  vertices_.attach(instances_.name(), {.location = INSTANCE_NORMAL_LOCATION,
                                       .components = 3,
                                       .stride = stride,
                                       .offset = offsetof(PlaneDisc, normal),
                                       .perInstance = true});
  vertices_.attach(instances_.name(), {.location = INSTANCE_COLLIDER_LOCATION,
                                       .components = 1,
                                       .stride = stride,
                                       .offset = offsetof(PlaneDisc, normal) + 12,
                                       .perInstance = true});
  vertices_.attach(instances_.name(), {.location = INSTANCE_LOOK_LOCATION,
                                       .stride = stride,
                                       .offset = offsetof(PlaneDisc, look),
                                       .perInstance = true});
}

void PlaneMesh::draw(std::size_t first, std::size_t count) const {
  if (count == 0) return;
  vertices_.bind();
  glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count),
                                    static_cast<GLuint>(first));
}

}  // namespace clothsim
