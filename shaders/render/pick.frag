// What lies under the cursor: who it is, where on the cloth, and how far from the eye.
#include "render/frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec2 fromCenter;  // of a plane's disc, 1 at its edge
layout(location = 3) flat in uint identity;
layout(location = 0) out uvec4 picked;

const float VISIBLE = 0.7;  // of a disc's squared radius: beyond, it has all but faded out

void main() {
  if (dot(fromCenter, fromCenter) > VISIBLE) discard;
  picked = uvec4(identity, floatBitsToUint(uv), floatBitsToUint(distance(position, frame.eye.xyz)));
}
