// Planes: a square around the stage in each plane; its fragments fade out towards a circle.
#include "render/frame.glsl"
#include "render/shadow_place.glsl"
#include "render/surface.glsl"

layout(location = INSTANCE_PLACE_LOCATION) in vec4 place;
layout(location = INSTANCE_NORMAL_LOCATION) in vec3 normal;
layout(location = 0) out Surface surface;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;  // a strip of two triangles
  vec3 helper = abs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 0, 1);
  vec3 tangent = normalize(cross(helper, normal));
  vec3 position = place.xyz + place.w * (corner.x * tangent + corner.y * cross(normal, tangent));
  surface = Surface(position, normal, corner, 0.0, shadowPlaceOf(position, normal));
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
