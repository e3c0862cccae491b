// One invocation: how many work groups the building of the hash gets, none when the old one serves. Before the clamp it is built
// for the start of the step: the hash of another step need not know all that were near then.
#include "shared/step_params.h"
#include "sim/self/common.glsl"

layout(local_size_x = 1) in;

// Four numbers a dispatch, the last unused: first what the passes are dispatched with, then what they need.
layout(std430, binding = DISPATCHES_BINDING) buffer Dispatches { uint groups[]; };

layout(std430, binding = WATCH_BINDING) readonly buffer Watch { uint watchRow[PASSES]; };

void main() {
  for (uint pass = 0u; pass < uint(PASSES); ++pass)
    if (watchRow[pass] != NO_DIVERGENCE) contacts.broken = 1u;
  if (contacts.broken != 0u) {
    contacts.fast = 0u;
    contacts.tooNear = 0u;
  }
  bool build = (contacts.stale != 0u || contacts.tooNear != 0u) && contacts.broken == 0u;
  uint passes = uint(groups.length()) / 2u;
  for (uint i = 0u; i < passes; ++i) groups[i] = build ? groups[passes + i] : 0u;
  contacts.hashBuilds += build ? 1u : 0u;
  contacts.fastSteps += contacts.fast;
  contacts.clampedSteps += contacts.tooNear;
  contacts.clamping = contacts.tooNear;
  contacts.stale = contacts.broken;
  contacts.fast = 0u;
  contacts.tooNear = 0u;
}
