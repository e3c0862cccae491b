// What the laws in shared/shapes/ are written in, as GLSL, and which of them this scene needs.
#ifndef LAW
#define LAW
#endif

bool hasType(uint type) { return (colliderTypes >> type & 1u) != 0u; }

// The nearest place of a surface, seen from a point.
struct Nearest {
  float distance;  // [m], negative inside
  vec3 normal;     // outward there
};

float distanceSample(uint i) { return texelFetch(distances, int(i)).x; }

#include "shared/shapes.h"

const uint shapesWithAxes = ~(1u << COLLIDER_SPHERE | 1u << COLLIDER_PLANE);
const bool hasShapes = (colliderTypes & shapesWithAxes) != 0u;

Nearest nearestOnShape(ColliderParams shape, vec3 p) {
#define NEAREST_IF(number, Struct, law) if (hasType(number) && shape.type == number) return law(shape, p);
  DISTANCE_SHAPES(NEAREST_IF)
  return Nearest(0.0, vec3(0.0));
}
