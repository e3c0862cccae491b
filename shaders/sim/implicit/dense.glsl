// The connected parts of the coarsest levels, and what their matrices, which are inverted, make of residuals. Needs
// residualOn(coarse vertex).
#include "sim/implicit/dense_part.glsl"

layout(binding = DENSE_UNIT) uniform samplerBuffer dense;

vec3 threeAt(uint entry) {
  return vec3(texelFetch(dense, int(entry)).x, texelFetch(dense, int(entry) + 1).x, texelFetch(dense, int(entry) + 2).x);
}

// The correction of the vertex that is `own` in the part.
RigidVector solvedFor(DensePart part, uint own) {
  uint order = 6u * part.count;
  precise vec3 translation = vec3(0.0);
  precise vec3 rotation = vec3(0.0);
  for (uint k = 0u; k < part.count; ++k) {
    uint coarse = part.first + k;
    RigidVector residual = forceAbout(fromOrigin(centerAt(coarse)), residualOn(coarse));
    for (uint j = 0u; j < 6u; ++j) {
      float r = j < 3u ? residual.translation[j] : residual.rotation[j - 3u];
      uint entry = part.firstEntry + (6u * k + j) * order + 6u * own;
      translation = translation - r * threeAt(entry);
      rotation = rotation - r * threeAt(entry + 3u);
    }
  }
  RigidVector motion = motionFrom(fromOrigin(centerAt(part.first + own)), RigidVector(translation, rotation));
  return RigidVector(canonical(motion.translation), canonical(motion.rotation));
}
