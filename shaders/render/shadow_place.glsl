// Where a point of a surface is looked up in the shadow map. It is moved along its normal, on the light's side, by as
// much as the filter's width may reach into the surface itself: no acne, and next to no gap at contacts.
#include "render/frame.glsl"

const float OFFSET_TEXELS = 2.0;

vec3 shadowPlaceOf(vec3 position, vec3 normal) {
  float facing = dot(normal, frame.toKeyLight.xyz);
  float grazing = sqrt(max(0.0, 1.0 - facing * facing));
  float offset = frame.toKeyLight.w * OFFSET_TEXELS * (0.35 + grazing) * (facing < 0.0 ? -1.0 : 1.0);
  return (frame.shadowFromWorld * vec4(position + offset * normal, 1.0)).xyz;
}
