// For the field tables of shapes: what every collider has at the end.
#pragma once

#include <array>

#include "scene/field.h"

namespace clothsim {

// The upper limit of friction depends on its law (scene_tree.cpp).
template <class Shape>
Field<Shape> frictionField() {
  return field("friction", &Shape::friction,
               "With cs184: 0 slides, 1 (the maximum) sticks. With coulomb: Coulomb's coefficient.")
      .within(notNegative)
      .usually(0, 1);
}
template <class Shape>
Field<Shape> motionField() {
  return field("motion", &Shape::motion, "A path in time along which the collider moves as a rigid body.");
}
template <class Shape>
Field<Shape> lookField() {
  return field("render", &Shape::render, "How this collider is drawn.");
}

}  // namespace clothsim
