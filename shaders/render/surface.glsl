// What a vertex shader tells a shading model about the surface.
struct Surface {
  vec3 position;     // [m]
  vec3 normal;       // of the front, not of unit length after interpolation
  vec2 uv;
  float hollow;      // how far the cloth around rises above the front, -1 to 1
  vec3 shadowPlace;  // in the shadow map, moved off the surface towards the light
#ifdef TANGENT
  vec3 tangent;      // along u, not of unit length after interpolation
#endif
#ifdef STRAIN
  float strain;      // l/L - 1
#endif
};
