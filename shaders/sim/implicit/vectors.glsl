// The vectors of conjugate gradients, which no other pass reads.
#include "sim/implicit/common.glsl"

layout(binding = RESIDUALS_UNIT) uniform samplerBuffer residuals;
layout(binding = CORRECTIONS_UNIT) uniform samplerBuffer corrections;
layout(binding = DIRECTIONS_UNIT) uniform samplerBuffer directions;
layout(binding = FACTORS_UNIT) uniform samplerBuffer factors;
layout(binding = PRODUCTS_UNIT) uniform samplerBuffer products;
