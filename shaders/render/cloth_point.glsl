// Where a vertex of the cloth is drawn, where light reaches it, and where it throws its shadow from: at its particle, or
// displaced by the height map, or, as cloth that is thick, on the surface of the side that the eye or the light sees.
#include "render/cloth_piece.glsl"

#ifdef DISPLACEMENT
#include "render/relief.glsl"
vec3 drawnPoint(vec3 position, vec4 normal, vec2 uv) {
  return position + normal.xyz * (frame.relief.y * textureLod(heights, textureAt(uv), 0.0).r);
}
#elif defined(THICK)
// On the back, -1, to the front, 1. The other side is not seen, so that one surface is enough, which goes over from the one
// to the other where it is seen from the edge.
float sideOf(float facing) { return clamp(12.0 * facing, -1.0, 1.0); }

// Of a bend it does so behind the silhouette, which is that of the outer side.
float facingOf(vec3 position, vec4 normal) {
  return dot(normal.xyz, normalize(frame.eye.xyz - position)) - clamp(1.5 * normal.w, -0.2, 0.2);
}
vec3 drawnPoint(vec3 position, vec4 normal, vec2 uv) {
  return position + normal.xyz * (frame.thickness * piece.halfThickness * sideOf(facingOf(position, normal)));
}
vec3 litPoint(vec3 position, vec4 normal, vec2 uv, vec3 toLight) {
  return position + normal.xyz * (frame.thickness * piece.halfThickness * sideOf(dot(normal.xyz, toLight)));
}
vec3 castingPoint(vec3 position, vec4 normal, vec2 uv, vec3 toLight) {
  return position + normal.xyz * (frame.casterThickness * piece.halfThickness * sideOf(dot(normal.xyz, toLight)));
}
#else
vec3 drawnPoint(vec3 position, vec4 normal, vec2 uv) { return position; }
#endif

#ifndef THICK
vec3 litPoint(vec3 position, vec4 normal, vec2 uv, vec3 toLight) { return drawnPoint(position, normal, uv); }
vec3 castingPoint(vec3 position, vec4 normal, vec2 uv, vec3 toLight) { return drawnPoint(position, normal, uv); }
#endif
