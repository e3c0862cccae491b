// What hangs on each coarse vertex, and with what weight.
#include "sim/implicit/vertices.glsl"

layout(binding = RESTRICTION_STARTS_UNIT) uniform usamplerBuffer restrictionStarts;
layout(binding = RESTRICTION_UNIT) uniform usamplerBuffer restriction;
