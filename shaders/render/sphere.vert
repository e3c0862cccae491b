// Spheres: a unit sphere's vertices, placed by instance. Normals are those of the round sphere.
#include "render/frame.glsl"
#include "render/shadow_place.glsl"
#include "render/surface.glsl"

layout(location = POSITION_LOCATION) in vec3 unitPosition;
layout(location = INSTANCE_PLACE_LOCATION) in vec4 place;
layout(location = INSTANCE_LOOK_LOCATION) in vec4 instanceLook;
layout(location = 0) out Surface surface;
layout(location = 8) flat out vec4 look;

void main() {
  look = instanceLook;
  vec3 position = place.xyz + place.w * unitPosition;
  surface = Surface(position, unitPosition, vec2(0), 0.0, shadowPlaceOf(position, unitPosition, SPHERE_OFFSET_TEXELS));
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
