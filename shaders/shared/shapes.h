// The shapes of colliders, as both backends know them: their numbers, and the laws of those that are known by
// a signed distance. Each law is one text that compiles as GLSL (sim/shapes.glsl) and as C++, as a member of
// cpu::ShapeLaws (solver/cpu/shapes.h). In it `real` is the type of numbers; a literal is written real(0.5);
// whatever an operation makes is a `precise` local, as docs/numeric-contract.md says.

// The places of the alternatives of Collider (src/scene/colliders/collider.h).
#define COLLIDER_SPHERE 0u
#define COLLIDER_PLANE 1u
#define COLLIDER_CAPSULE 2u
#define COLLIDER_BOX 3u
#define COLLIDER_TORUS 4u
#define COLLIDER_MESH 5u
#define COLLIDER_CYLINDER 6u
#define COLLIDER_CONE 7u
#define COLLIDER_DEFORMS 16u  // none of them: stands among the types of a scene where some mesh deforms

#ifdef LAW
#include "shared/shapes/box.h"
#include "shared/shapes/capsule.h"
#include "shared/shapes/cone.h"
#include "shared/shapes/cylinder.h"
#include "shared/shapes/mesh.h"
#include "shared/shapes/torus.h"
#endif

// EACH(number, struct of the scene, law): all shapes but the sphere and the plane, whose contacts have laws
// of their own.
#define DISTANCE_SHAPES(EACH)                          \
  EACH(COLLIDER_CAPSULE, Capsule, nearestOnCapsule)    \
  EACH(COLLIDER_BOX, Box, nearestOnBox)                \
  EACH(COLLIDER_TORUS, Torus, nearestOnTorus)          \
  EACH(COLLIDER_MESH, MeshCollider, nearestOnMesh)     \
  EACH(COLLIDER_CYLINDER, Cylinder, nearestOnCylinder) \
  EACH(COLLIDER_CONE, Cone, nearestOnCone)
