// How many work groups the building of the hash gets, none when the old one serves: the last of the groups that have looked for a
// need decides it. Before the clamp the hash is built for the start of the step: that of another step need not know all
// that were near then.
#include "sim/last_group.glsl"

// Four numbers a dispatch, the last unused: first what the passes are dispatched with, then what they need.
layout(std430, binding = DISPATCHES_BINDING) buffer Dispatches { uint groups[]; };

layout(std430, binding = WATCH_BINDING) readonly buffer Watch { uint watchRow[PASSES]; };

// For all invocations of a group, when they have looked.
void planAfterAll() {
  if (!isLastGroupOf(self.gridGroups) || gl_LocalInvocationIndex != 0u) return;
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
