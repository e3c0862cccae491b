// Normals, tangents, hollows and strains of a mesh, as normals.comp has them for grids: each particle gathers over its
// triangles, which come as lists.
#include "render/cloth_piece.glsl"

layout(local_size_x = MESH_NORMALS_GROUP) in;
layout(binding = NORMALS_POSITIONS_UNIT) uniform samplerBuffer positions;  // a texel a particle
layout(std430, binding = NORMALS_OUT_BINDING) writeonly buffer Normals { vec4 normals[]; };
layout(std430, binding = TANGENTS_OUT_BINDING) writeonly buffer Tangents { vec4 tangents[]; };
layout(binding = MESH_CORNERS_UNIT) uniform usamplerBuffer corners;        // a texel a word
layout(std430, binding = MESH_COORDINATES_BINDING) readonly buffer Coordinates { vec2 coordinates[]; };

vec3 placeOf(uint particle) { return texelFetch(positions, int(particle)).xyz; }
uint cornerAt(uint word) { return texelFetch(corners, int(word)).r; }

#ifdef STRAIN
layout(std430, binding = REST_POSITIONS_BINDING) readonly buffer RestPositions { vec4 restPositions[]; };

float strainOf(uint a, uint b) {
  float rest = distance(restPositions[a].xyz, restPositions[b].xyz);
  return distance(placeOf(a), placeOf(b)) / max(rest, 1e-12) - 1.0;
}
#else
float strainOf(uint a, uint b) { return 0.0; }
#endif

// The mean sine of the elevation of the points on a ring around the particle, seen from it.
float hollowAt(uint ring, vec3 here, vec3 normal) {
  float sum = 0.0;
  for (uint k = 0u; k < MESH_RING; ++k) {
    vec3 d = placeOf(cornerAt(ring + k)) - here;
    sum += dot(d, normal) / max(length(d), 1e-9);
  }
  return sum / float(MESH_RING);
}

void main() {
  uint local = gl_GlobalInvocationID.x;
  if (local >= piece.columns) return;
  uint i = piece.firstParticle + local;
  vec3 here = placeOf(i);
  vec3 sum = vec3(0), along = vec3(0);
  float strain = -1.0;
  // Of every triangle around the particle the two other corners in their order, and where the triangle has texture coordinates
  // of its own, or 0.
  for (uint at = cornerAt(local), end = cornerAt(local + 1u); at < end; at += 3u) {
    uint next = cornerAt(at), previous = cornerAt(at + 1u), own = cornerAt(at + 2u);
    bool isAtSeam = own != 0u;
    vec3 p = placeOf(next) - here, q = placeOf(previous) - here;
    vec2 uv = coordinates[isAtSeam ? own : i];
    vec2 uvP = coordinates[isAtSeam ? own + 1u : next] - uv, uvQ = coordinates[isAtSeam ? own + 2u : previous] - uv;
    sum += cross(p, q);
    along += sign(uvP.x * uvQ.y - uvQ.x * uvP.y) * (uvQ.y * p - uvP.y * q);
    strain = max(strain, max(strainOf(i, next), strainOf(i, previous)));
  }
  float area = length(sum);
  vec3 normal = area > 0.0 ? sum / area : vec3(0, 1, 0);
  uint firstRing = cornerAt(piece.columns);  // rings lie behind the triangles
  normals[i] = vec4(normal, hollowAt(firstRing + local * MESH_RING, here, normal));
  along -= dot(along, normal) * normal;
  float l = length(along);
  vec3 anyAcross = cross(normal, abs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 0, 1));
  tangents[i] = vec4(l > 0.0 ? along / l : normalize(anyAcross), strain);
}
