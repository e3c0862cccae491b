// The square around a plane's drawn disc: a strip of two triangles.
vec2 discCorner() { return vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0; }

vec3 onDisc(vec4 place, vec3 normal, vec2 corner) {
  vec3 helper = abs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 0, 1);
  vec3 tangent = normalize(cross(helper, normal));
  return place.xyz + place.w * (corner.x * tangent + corner.y * cross(normal, tangent));
}
