// What cloth.vert tells fabric.frag where light is worked out at the vertices.
struct LitVertex {
  vec2 uv;
  vec3 front, back;  // light of each side, without the shine
  vec2 along;        // how the threads lie to the light (fabric_light.glsl)
  vec2 shine;        // what part of the shine is seen, of front and back
  float warp;        // part of the front that is warp
};
