// The generated sky; the cube map keeps square roots of half the light.
#include "shared/render_layout.h"

layout(binding = ENVIRONMENT_UNIT) uniform samplerCube sky;

vec3 skyLight(vec3 direction) {
  vec3 root = texture(sky, direction).rgb;
  return 2.0 * root * root;
}
