// A particle of the product of the Hessian H and the directions p. Needs sim/implicit/scalars.glsl, and sim/implicit/common.glsl
// with positionAt() for p, so that what is linear serves as it is. MULTIPLIES_PAIRS: what pairs do to the directions is worked out
// here, too, once for each of their particles; otherwise sim/surface/multiply_pairs.comp has done so.
#include "sim/watch.glsl"
#include "sim/incident_springs.glsl"
#include "sim/bending.glsl"
#include "sim/implicit/contact.glsl"
#if HAS_SURFACE
#include "sim/surface/pairs_of_particles.glsl"
#if MULTIPLIES_PAIRS
vec3 directionAt(uint i) { return positionAt(i).xyz; }
#include "sim/surface/pair_product.glsl"
#else
vec3 pairProduct(uint q) { return pairRow(q, 3u).xyz; }
#endif
#endif
#if HAS_MESH
#include "sim/implicit/mesh.glsl"
#endif
#if HAS_SEAMS
#include "sim/implicit/seams.glsl"
#endif

vec3 productAt(GridPoint point) {
  uint i = point.index;
  vec4 x = iterateAt(i);
  vec3 p = positionAt(i).xyz;
  bool isExact = scalars.hessian == HESSIAN_EXACT;
#if HAS_MESH
  precise vec3 force = meshProducts(i, isExact);
#else
  uint cut = cutMaskOf(i);
  precise vec3 force = vec3(0.0);
  for (uint k = 0u; k < INCIDENT_SPRINGS; ++k) {
    IncidentSpring spring = incidentSpring(point, k, cut);
    if (!spring.exists) continue;
    precise vec3 d = iterateAt(spring.other).xyz - x.xyz;
    precise vec3 e = positionAt(spring.other).xyz - p;
    SpringBlock s = springBlock(d, spring, isExact);
    precise vec3 f = s.across * e + (s.along * sumOfProducts(d, e)) * d;
    force = force + f;
  }
  if (hasMaterial) force = addBending(point, force);
#endif
#if HAS_SEAMS
  force = addSeamProducts(i, force);
#endif
#if HAS_SURFACE
  uvec2 range = pairsOf(i);
  precise vec3 ofPairs = vec3(0.0);
  for (uint k = range.x; k < range.y; ++k) {
    uint entry = pairEntry(k), q = entry / 4u;
    ofPairs = ofPairs + pairRow(q, 1u)[entry % 4u] * pairProduct(q);
  }
  if (scalars.pairs != 0u) force = force - ofPairs;
#endif
  float diagonal = texelFetch(rightHandSides, int(i)).w;
  precise vec3 product = diagonal * p;
  if (hasWind) product = product + timesVector(airBlockAt(i), p);
  if (hasContacts) product = product + timesVector(contactBlockAt(i), p);
  precise vec3 result = product - force;
  return x.w == 0.0 ? vec3(0.0) : canonical(result);
}
