// Bump mapping: the height map tilts the normal; the surface stays where the particles are.
#include "render/bumped.glsl"

void main() { shadeBumped(); }
