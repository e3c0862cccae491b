// The shadow on floors: the casters' outline as the light sees it, blurred along one axis at a time. Far softer than
// filtering the shadow map could be, for one texture tap a pixel; floors cast no shadow, so depth plays no part.
#include "shared/render_layout.h"

#ifdef FIRST_AXIS
layout(binding = SHADOW_MAP_UNIT) uniform sampler2DShadow shadowMap;
float lightAt(vec2 place) { return texture(shadowMap, vec3(place, 0.999999)); }  // 1 where nothing was drawn
const vec2 AXIS = vec2(1, 0);
#else
layout(binding = FLOOR_SHADOW_UNIT) uniform sampler2D firstAxis;
float lightAt(vec2 place) { return texture(firstAxis, place).r; }
const vec2 AXIS = vec2(0, 1);
#endif

const int RADIUS = 6;            // [texels]
const float DEVIATION = 2.4;

layout(location = 0) out vec4 light;

void main() {
  const vec2 texel = vec2(1.0 / FLOOR_SHADOW_SIZE);
  float sum = 0.0, weights = 0.0;
  for (int i = -RADIUS; i <= RADIUS; ++i) {
    float weight = exp(-0.5 * float(i * i) / (DEVIATION * DEVIATION));
    sum += weight * lightAt((gl_FragCoord.xy + float(i) * AXIS) * texel);
    weights += weight;
  }
  light = vec4(sum / weights);
}
