// What every shape of a collider says of itself; scene/colliders/collider.h lists the shapes. The own frame
// of a shape has its place at the origin and is rotated by ownRotation().
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/vec.h"
#include "scene/colliders/solid_look.h"
#include "scene/motion.h"
#include "scene/put.h"
#include "scene/rotation.h"

namespace clothsim {

template <class Owner>
struct Field;  // scene/field.h

// The surface of a shape in its own frame, for drawing; triangles are counter-clockwise from outside.
struct Surface {
  struct Vertex {
    Vec3f position, normal;
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

// A key of a shape whose value does not fit the others.
struct Misfit {
  std::string_view key;
  std::string_view expected;      // "a tube_radius below the radius ",
  std::optional<double> limit{};  // and the number at the end of that
};

// What the user writes. A shape may have `std::optional<Misfit> finishReading(const IsGiven&)`, too, which is
// called after reading, and makes defaults fit to what is given.
using IsGiven = std::function<bool(std::string_view key)>;
template <class S>
concept WrittenShape = requires(S shape, const S& fixed) {
  { S::type } -> std::convertible_to<std::string_view>;               // in scene files
  { S::fields() } -> std::convertible_to<std::span<const Field<S>>>;  // of the scene file
  { shape.place() } -> std::same_as<Vec3d&>;                          // its origin or point [m]
  { fixed.ownRotation() } -> std::same_as<Matrix3>;                   // before any motion
  { shape.friction } -> std::convertible_to<double>;
  { shape.motion } -> std::convertible_to<std::optional<Motion>>;
  { shape.render } -> std::convertible_to<SolidLook>;
};

// What the program makes of it: of most shapes the same type, of a mesh the one that holds its samples.
template <class S, class Params>
concept SolidShape = requires(const S& shape, Params& params, Vec3d p, const Matrix3& rotation) {
  shape.pack(params, rotation);                           // for the passes; `rotation`: of its motion
  { shape.distance(p) } -> std::same_as<double>;          // from p to the surface, negative inside [m]
  { shape.surface(0.1) } -> std::same_as<Surface>;        // see drawnSurface() in collider_set.h
  { shape.halfExtent(rotation) } -> std::same_as<Vec3d>;  // of the box around it when it is rotated [m]
};

}  // namespace clothsim
