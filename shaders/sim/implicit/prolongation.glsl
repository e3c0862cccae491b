// Corrections of vertices: their own, D^-1 r, and what the aggregates that they hang on make of them. Needs
// correctionOn(coarse vertex).
#include "sim/implicit/vectors.glsl"
#include "sim/implicit/vertices.glsl"

layout(binding = COARSE_INVERSES_UNIT) uniform samplerBuffer coarseInverses;

RigidVector prolonged(uint vertex) {
  precise vec3 translation = vec3(0.0);
  precise vec3 rotation = vec3(0.0);
  uvec2 range = rangeAt(prolongationStarts, vertex);
  for (uint n = range.x; n < range.y; ++n) {
    Weight weight = weightAt(prolongation, n);
    RigidVector motion = correctionOn(weight.vertex);
    translation = translation + weight.weight * motion.translation;
    rotation = rotation + weight.weight * motion.rotation;
  }
  return RigidVector(translation, rotation);
}

Factors factorsAt(uint i) {
  return Factors(texelFetch(factors, int(2u * i)).xyz, texelFetch(factors, int(2u * i + 1u)).xyz);
}

// Pinned particles get 0.
vec3 correctionOfParticle(uint i, vec3 residual) {
  RigidVector motion = prolonged(i);
  precise vec3 moved = motion.translation + crossProduct(motion.rotation, fromOrigin(iterateAt(i).xyz));
  precise vec3 correction = solveFor(factorsAt(i), residual) + moved;
  return iterateAt(i).w == 0.0 ? vec3(0.0) : canonical(correction);
}

RigidVector correctionOfCoarse(uint coarse, RigidVector residual) {
  vec3 center = fromOrigin(centerAt(coarse));
  RigidVector motion = prolonged(step.totalParticles + coarse),
              minus = motionFrom(center, timesRigid(loadBlock(coarseInverses, coarse), forceAbout(center, residual)));
  precise vec3 translation = motion.translation - minus.translation;
  precise vec3 rotation = motion.rotation - minus.rotation;
  return RigidVector(canonical(translation), canonical(rotation));
}
