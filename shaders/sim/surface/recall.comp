// Pairs that the step before has found, too, begin with the friction that it ended with; the twin is recallSlips() in
// src/solver/cpu/surface_pairs.cpp.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(binding = PAIR_IDS_UNIT) uniform usamplerBuffer pairIds;
layout(binding = PAIR_SLIPS_UNIT) uniform usamplerBuffer pairSlips;
layout(binding = KEPT_IDS_UNIT) uniform usamplerBuffer keptIds;
layout(binding = KEPT_SLIPS_UNIT) uniform usamplerBuffer keptSlips;
layout(std430, binding = PAIR_SLIPS_BINDING) writeonly buffer Slips { uvec4 newSlips[]; };
layout(std430, binding = SURFACE_CARRIES_BINDING) writeonly buffer Carries { vec4 newCarries[]; };

uint keptPlace(uint k) { return texelFetch(keptSlips, int(2u * k)).w; }

// The first of the step before that is not before this place.
uint firstKeptAt(uint place) {
  uint first = 0u, end = state.keptPairs;
  while (first < end) {
    uint middle = (first + end) / 2u;
    if (keptPlace(middle) < place)
      first = middle + 1u;
    else
      end = middle;
  }
  return first;
}

void main() {
  uint q = thisEntry();
  if (q >= state.pairs || isSettled()) return;
  uvec4 ids = texelFetch(pairIds, int(q));
  uint place = texelFetch(pairSlips, int(2u * q)).w, k = firstKeptAt(place);
  while (k < state.keptPairs && keptPlace(k) == place && texelFetch(keptIds, int(k)) != ids) ++k;
  bool isKnown = k < state.keptPairs && keptPlace(k) == place;
  uvec3 slip = isKnown ? texelFetch(keptSlips, int(2u * k)).xyz : uvec3(0u);
  precise vec3 carry = vec3(0.0) - uintBitsToFloat(slip);
  newSlips[2u * q] = uvec4(slip, place);
  newSlips[2u * q + 1u] = isKnown ? texelFetch(keptSlips, int(2u * k + 1u)) : uvec4(0u);
  newCarries[q] = vec4(carry, 0.0);
}
