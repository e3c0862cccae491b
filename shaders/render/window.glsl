// What the window lets in of the key light where the stage is a room by a window: a wide pane, and around it parts of the
// next ones. `place` is in the shadow map, which the light looks along.
#include "render/frame.glsl"

const vec2 PANE = vec2(0.50, 0.56);     // half its size, in sizes of the scene
const vec2 OPENING = vec2(1.36, 1.30);  // half the window's
const float BAR = 0.035, PENUMBRA = 0.05, WALL = 0.05;  // WALL: light that comes in otherwise

float windowLight(vec2 place) {
  vec3 right = vec3(frame.shadowFromWorld[0].x, frame.shadowFromWorld[1].x, frame.shadowFromWorld[2].x);
  float metres = inversesqrt(dot(right, right));
  vec2 at = abs(place - 0.5) * (metres / frame.stagePlace.w * STAGE_SIZES);
  vec2 open = 1.0 - smoothstep(OPENING - PENUMBRA, OPENING + PENUMBRA, at);
  vec2 bars = smoothstep(vec2(BAR - PENUMBRA), vec2(BAR + PENUMBRA), abs(at - PANE));
  return mix(WALL, 1.0, open.x * open.y * mix(1.0, bars.x * bars.y, 0.8));
}
