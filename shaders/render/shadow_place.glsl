// Where a point of a surface is looked up in the shadow map. Cloth is moved along its normal, on the light's side, by as
// much as the filter and its own facets reach: no acne, and next to no gap at contacts. Spheres need no such offset,
// because only their far sides are in the map.
#include "render/frame.glsl"

const float CLOTH_OFFSET_TEXELS = 4.0;
const float SPHERE_OFFSET_TEXELS = 0.0;

vec3 shadowPlaceOf(vec3 position, vec3 normal, float texels) {
  float facing = dot(normal, frame.toKeyLight.xyz);
  float grazing = sqrt(max(0.0, 1.0 - facing * facing));
  float offset = frame.toKeyLight.w * texels * (0.35 + grazing) * (facing < 0.0 ? -1.0 : 1.0);
  return (frame.shadowFromWorld * vec4(position + offset * normal, 1.0)).xyz;
}
