// What cloth.vert tells fabric.frag where light is worked out at the vertices.
#ifdef PLAIN
struct LitVertex {
  vec2 uv;
  vec3 shadowPlace;
  vec3 front, frontKey, back, backKey;  // light of each side, of white cloth with PRINT, without the key light, and what that adds
  float warp;                           // part of the front that is warp
};
#else
struct LitVertex {
  vec2 uv;
  vec3 front, back;  // light of each side, without the shine
  vec2 along;        // how the threads lie to the light (fabric_light.glsl)
  vec2 shine;        // what part of the shine is seen, of front and back
  float warp;        // part of the front that is warp
};
#endif
