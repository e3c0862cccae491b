// Where a vertex of the cloth is drawn: at its particle, or displaced by the height map.
#ifdef DISPLACEMENT
#include "render/relief.glsl"
vec3 drawnPoint(vec3 position, vec3 normal, vec2 uv) {
  return position + normal * (frame.relief.y * textureLod(heights, textureAt(uv), 0.0).r);
}
#else
vec3 drawnPoint(vec3 position, vec3 normal, vec2 uv) { return position; }
#endif
