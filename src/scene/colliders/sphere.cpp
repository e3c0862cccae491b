#include "scene/colliders/sphere.h"

#include "scene/colliders/shape_fields.h"

namespace clothsim {

std::span<const Field<Sphere>> Sphere::fields() {
  static const std::array fields{
      field("origin", &Sphere::origin, "Centre of a shape other than a plane.").in("m"),
      field("radius", &Sphere::radius, "Radius of a round shape; of a torus, of the circle inside its tube.")
          .in("m")
          .within(positive)
          .usually(0.01, 1),
      frictionField<Sphere>(),
      motionField<Sphere>(),
      lookField<Sphere>(),
  };
  return fields;
}

}  // namespace clothsim
