// What a pair does to the directions: a force on its first part. Needs sim/surface/pairs.glsl, and directionAt().
vec3 pairProduct(uint q) {
  uvec4 ids = texelFetch(pairIds, int(q));
  vec3 normal = pairRow(q, 0u).xyz;
  float held = pairRow(q, 2u).w, across = pairRow(q, 3u).w;
  vec3 moved = weightedSum(pairRow(q, 1u), directionAt(ids.x), directionAt(ids.y), directionAt(ids.z), directionAt(ids.w));
  precise float beyond = (held - across) * sumOfProducts(normal, moved);
  precise vec3 force = across * moved + beyond * normal;
  return canonical(force);
}
