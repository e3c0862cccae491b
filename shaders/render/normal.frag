// The normal as a colour: x, y and z from -1 to 1 are red, green and blue from 0 to 1. The back shows its own normal.
#include "render/frame.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/two_sided.glsl"

void main() { color = vec4(canvasFromSrgb(0.5 + 0.5 * normalToEye()), 1.0); }
