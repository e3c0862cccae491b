#include "scene/colliders/plane.h"

#include "scene/colliders/shape_fields.h"

namespace clothsim {

std::span<const Field<Plane>> Plane::fields() {
  static const std::array fields{
      field("point", &Plane::point, "Any point of a plane.").in("m"),
      field("normal", &Plane::normal, "Normal of a plane, of any length.").within({.nonZero = true}),
      frictionField<Plane>(),
      motionField<Plane>(),
      lookField<Plane>(),
  };
  return fields;
}

}  // namespace clothsim
