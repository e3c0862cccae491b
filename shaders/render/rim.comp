// The edge of cloth (src/render/cloth_rim.h): at each point of a border half a circle around it, of half the thickness, from
// the front over the outside to the back. The middle is there twice: points of the back have the normal of the front, as
// all of the cloth has, and triangles that are turned the other way.
#include "shared/render_layout.h"

layout(local_size_x = SMOOTH_GROUP) in;
layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = NORMALS_OUT_BINDING) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = TANGENTS_OUT_BINDING) readonly buffer Tangents { vec4 tangents[]; };
layout(std430, binding = RIM_CORNERS_BINDING) readonly buffer Corners { uvec4 corners[]; };
layout(std430, binding = SMOOTH_POINTS_BINDING) writeonly buffer Points { vec4 rimPoints[]; };
layout(std430, binding = SMOOTH_NORMALS_BINDING) writeonly buffer RimNormals { vec4 rimNormals[]; };
layout(std430, binding = SMOOTH_TANGENTS_BINDING) writeonly buffer RimTangents { vec4 rimTangents[]; };

#ifdef LEAN
layout(std430, binding = RIM_PLACES_BINDING) readonly buffer Places { uint places[]; };
uint placeOf(uint point) { return places[point]; }  // the edge is where the triangles end
#else
uint placeOf(uint point) { return point; }
#endif

const float PI = 3.14159265;
const float LEAST_LENGTH = 1e-12;

void main() {
  uint at = gl_GlobalInvocationID.x;
  if (at >= uint(corners.length())) return;
  uvec4 corner = corners[at];
  uint place = placeOf(corner.y);
  float radius = uintBitsToFloat(corner.w);
  vec3 here = positions[place].xyz, normal = normals[place].xyz, u = tangents[place].xyz;
  vec3 along = positions[corner.z].xyz - positions[corner.x].xyz;
  along -= dot(along, normal) * normal;
  float l = length(along);
  along = l > LEAST_LENGTH ? along / l : u;
  vec3 outwards = cross(along, normal);
  for (uint k = 0u; k < RIM_POINTS; ++k) {
    bool isFront = k < RIM_POINTS / 2u;
    float side = isFront ? 1.0 : -1.0, angle = PI * float(isFront ? k : k - 1u) / float(RIM_POINTS - 2u);
    vec3 radial = cos(angle) * normal + sin(angle) * outwards;
    vec3 onwards = side * (cos(angle) * outwards - sin(angle) * normal);  // where texture coordinates go outwards
    uint point = RIM_POINTS * at + k;
    rimPoints[point] = vec4(here + radius * radial, 1.0);
    rimNormals[point] = vec4(side * radial, normals[place].w);
    rimTangents[point] = vec4(dot(u, along) * along + dot(u, outwards) * onwards, tangents[place].w);
  }
}
