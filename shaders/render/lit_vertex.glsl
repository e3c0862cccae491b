// What cloth.vert tells fabric.frag where light is worked out at the vertices.
#ifdef PLAIN
struct LitVertex {
  vec2 uv;
  vec3 shadowPlace;
  vec3 front, frontKey, back, backKey;  // light of each side, of white cloth with PRINT, without the key light, and what that adds
  float warp;                           // part of the front that is warp
};
#else
// Packed, since llvmpipe sets up each vector for every triangle.
struct LitVertex {
  vec4 front, back;  // light of each side, without the shine; how the threads lie to the light (fabric_light.glsl): along u, along v
  vec4 cloth;        // uv; what part of the shine is seen, less than 0: of the back; part of the front that is warp
};
#endif
