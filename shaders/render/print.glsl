// A picture on the cloth; linear light when sampled.
#include "render/relief.glsl"

layout(binding = PRINT_UNIT) uniform sampler2D print;

vec3 printAt(vec2 uv) { return texture(print, textureAt(uv)).rgb; }
