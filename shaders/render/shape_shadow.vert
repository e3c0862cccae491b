// Capsules, boxes and tori into the shadow map.
#include "render/frame.glsl"

layout(location = POSITION_LOCATION) in vec3 ownPosition;
layout(location = INSTANCE_ROWS_LOCATION) in vec4 rowX;
layout(location = INSTANCE_ROWS_LOCATION + 1) in vec4 rowY;
layout(location = INSTANCE_ROWS_LOCATION + 2) in vec4 rowZ;

void main() {
  vec4 p = vec4(ownPosition, 1.0);
  vec3 position = vec3(dot(rowX, p), dot(rowY, p), dot(rowZ, p));
  gl_Position = vec4((frame.shadowFromWorld * vec4(position, 1.0)).xyz * 2.0 - 1.0, 1.0);
}
