// Capsules, boxes and tori: each a mesh in its own frame, placed by an instance's three rows.
#include "render/frame.glsl"
#include "render/shadow_place.glsl"
#include "render/surface.glsl"

layout(location = POSITION_LOCATION) in vec3 ownPosition;
layout(location = NORMAL_LOCATION) in vec3 ownNormal;
layout(location = INSTANCE_ROWS_LOCATION) in vec4 rowX;
layout(location = INSTANCE_ROWS_LOCATION + 1) in vec4 rowY;
layout(location = INSTANCE_ROWS_LOCATION + 2) in vec4 rowZ;
layout(location = INSTANCE_LOOK_LOCATION) in vec4 instanceLook;
layout(location = 0) out Surface surface;
layout(location = 8) flat out vec4 look;

void main() {
  look = instanceLook;
  vec4 p = vec4(ownPosition, 1.0);
  vec3 position = vec3(dot(rowX, p), dot(rowY, p), dot(rowZ, p));
  vec3 normal = vec3(dot(rowX.xyz, ownNormal), dot(rowY.xyz, ownNormal), dot(rowZ.xyz, ownNormal));
  surface = Surface(position, normal, vec2(0), 0.0, shadowPlaceOf(position, normal, SPHERE_OFFSET_TEXELS));
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
