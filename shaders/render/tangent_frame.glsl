// Directions on the surface along the cloth's own u and v. With TANGENT.
#include "render/surface.glsl"

struct TangentFrame {
  vec3 u, v, normal;  // unit; `normal` faces the eye
};

TangentFrame tangentFrame(Surface surface, float side) {
  vec3 front = normalize(surface.normal);
  vec3 u = normalize(surface.tangent - dot(surface.tangent, front) * front);
  return TangentFrame(u, cross(u, front), front * side);
}

// The normal of a surface that rises by `slope` along u and v.
vec3 tilted(TangentFrame t, vec2 slope) { return normalize(t.normal - slope.x * t.u - slope.y * t.v); }
