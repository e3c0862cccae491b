// The colour of the threads at a place of a side, 1 for the front, -1 for the back.
#include "render/frame.glsl"
#ifdef PRINT
#include "render/print.glsl"

const float PRINT_SEEN_FROM_BEHIND = 0.45;
#endif

vec3 dyeAt(vec2 uv, float side) {
  vec3 dye = side > 0.0 ? frame.clothFront.rgb : frame.clothBack.rgb;
#ifdef PRINT
  vec3 print = printAt(uv);
  dye = side > 0.0 ? print : mix(dye, print, PRINT_SEEN_FROM_BEHIND);
#endif
  return dye;
}
