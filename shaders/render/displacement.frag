// Displacement mapping: cloth.vert moves the vertices by the height map, and the normal follows it in between.
#include "render/bumped.glsl"

void main() { shadeBumped(); }
