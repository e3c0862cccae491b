// Cloth has a front and a back. Before the include: `surface`.
float facingSide() { return gl_FrontFacing ? 1.0 : -1.0; }
vec3 normalToEye() { return normalize(surface.normal) * facingSide(); }
vec3 albedoOfSide() { return gl_FrontFacing ? frame.clothFront.rgb : frame.clothBack.rgb; }
