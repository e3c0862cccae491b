// Points of the smooth surface of triangles (src/render/patches.h), with their normals and tangents. The point between three
// corners goes half the way to where the corners' tangent planes have it, on average by its weights (T. Boubekeur, M. Alexa,
// "Phong Tessellation", 2008): of a sphere's normals that gives the sphere, to the third order of the side. Points on a side
// depend on its ends alone. A border is a curve of its own through its particles (E. Catmull, R. Rom, "A Class of Local
// Interpolating Splines", 1974).
#include "render/cloth_piece.glsl"

layout(local_size_x = SMOOTH_GROUP) in;
layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = NORMALS_OUT_BINDING) readonly buffer ParticleNormals { vec4 particleNormals[]; };
layout(std430, binding = TANGENTS_OUT_BINDING) readonly buffer ParticleTangents { vec4 particleTangents[]; };
layout(std430, binding = PATCH_SHARES_BINDING) readonly buffer Shares { float shares[]; };  // as in smooth_points.comp
layout(std430, binding = PATCH_POINTS_BINDING) readonly buffer Patches { uvec4 patchPoints[]; };  // particles, steps
layout(std430, binding = SMOOTH_POINTS_BINDING) writeonly buffer Points { vec4 points[]; };
layout(std430, binding = SMOOTH_NORMALS_BINDING) writeonly buffer Normals { vec4 normals[]; };
layout(std430, binding = SMOOTH_TANGENTS_BINDING) writeonly buffer Tangents { vec4 tangents[]; };

#include "render/patch_point.glsl"

vec3 unit(vec3 v, vec3 otherwise) {
  float l = length(v);
  return l > 0.0 ? v / l : otherwise;
}

vec3 onBorder(uvec4 p, float t) {
  vec3 a = positions[p.x].xyz, b = positions[p.y].xyz, c = positions[p.z].xyz, d = positions[p.w].xyz;
  return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

vec4 flatCorner(uint particle) { return vec4(positions[particle].xyz, shares[particle]); }

void main() {
  uint at = gl_GlobalInvocationID.x;
  if (2u * at >= uint(patchPoints.length())) return;
  uvec4 p = patchPoints[2u * at], steps = patchPoints[2u * at + 1u];
  vec3 w = vec3(steps.xyz) / float(steps.x + steps.y + steps.z);
  bool isBorder = steps.w == 1u;
  vec4 normal = w.x * particleNormals[p.x] + w.y * particleNormals[p.y] + w.z * particleNormals[p.z];
  vec4 tangent = w.x * particleTangents[p.x] + w.y * particleTangents[p.y] + w.z * particleTangents[p.z];
  vec3 n = unit(normal.xyz, vec3(0, 1, 0));
  vec3 anyAcross = normalize(cross(n, abs(n.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 0, 1)));
  uint point = piece.firstPoint + at;
  vec3 place = isBorder ? onBorder(p, w.z) : onPatch(p.xyz, w);
  if (piece.hasLayers > 0.0) {
    vec4 flatPlace = w.x * flatCorner(p.x) + w.y * flatCorner(p.y) + w.z * flatCorner(p.z);
    place = mix(flatPlace.xyz, place, flatPlace.w);
  }
  points[point] = vec4(place, 1.0);
  normals[point] = vec4(n, normal.w);
  tangents[point] = vec4(unit(tangent.xyz - dot(tangent.xyz, n) * n, anyAcross), tangent.w);
}
