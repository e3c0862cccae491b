// Copies a buffer, 16 bytes an invocation.
layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly restrict buffer Source { vec4 source[]; };
layout(std430, binding = 1) writeonly restrict buffer Target { vec4 target[]; };

void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 256u + gl_LocalInvocationIndex;
  if (i < uint(source.length())) target[i] = source[i];
}
