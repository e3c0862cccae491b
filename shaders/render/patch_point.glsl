// A point of the smooth surface of a triangle, whose corners count w. Before the include: `positions`, `particleNormals`.
const float SHARE = 0.5;

vec3 onTangentPlane(vec3 point, uint particle) {
  vec3 normal = particleNormals[particle].xyz;
  return point - dot(point - positions[particle].xyz, normal) * normal;
}

vec3 onPatch(uvec3 p, vec3 w) {
  vec3 flatPoint = w.x * positions[p.x].xyz + w.y * positions[p.y].xyz + w.z * positions[p.z].xyz;
  vec3 onPlanes = w.x * onTangentPlane(flatPoint, p.x) + w.y * onTangentPlane(flatPoint, p.y);
  return mix(flatPoint, onPlanes + w.z * onTangentPlane(flatPoint, p.z), SHARE);
}
