// Where a canvas of one sample a pixel has edges. Before the include: `canvas`.
#include "render/frame.glsl"
#include "render/tone.glsl"

const float LEAST_CONTRAST = 0.04, LEAST_SHARE = 0.1;  // of an edge, and as a part of what is brightest there

float brightness(vec3 canvasColor) { return dot(canvasColor, vec3(0.3, 0.6, 0.1)); }
vec4 canvasAt(ivec2 pixel) { return texelFetch(canvas, clamp(pixel, ivec2(0), ivec2(frame.pixels.xy) - 1), 0); }
float brightnessAt(ivec2 pixel) { return brightness(canvasAt(pixel).rgb); }

// Whether something lies before the stage there, whose own edges are smooth and whose boards would be blurred.
bool isBeforeStage(vec4 canvasColor) { return canvasColor.a > 0.5 * (1.0 + STAGE_ALPHA); }

// Of a pixel and the four around it.
bool isContrast(float least, float most) { return most - least >= max(LEAST_CONTRAST, LEAST_SHARE * most); }
