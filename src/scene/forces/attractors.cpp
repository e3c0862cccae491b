#include "scene/forces/attractors.h"

#include <array>

#include "scene/field.h"

namespace clothsim {

std::span<const Field<Attractor>> Attractor::fields() {
  using A = Attractor;
  static const std::array fields{
      field("position", &A::position, "Place of an attractor.").in("m"),
      field("strength", &A::strength,
            "Largest acceleration towards an attractor, at radius / sqrt(5); negative: away from it.")
          .in("m/s^2")
          .within({.low = -1e6, .high = 1e6})
          .usually(-50, 50),
      field("radius", &A::radius, "Distance from which on an attractor does nothing.")
          .in("m")
          .within(positive)
          .usually(0.05, 2),
  };
  return fields;
}

}  // namespace clothsim
