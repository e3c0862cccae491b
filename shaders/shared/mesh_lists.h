// Springs, bending and triangles of meshes as the passes read them (src/solver/mesh_lists.h): buffers read as
// texels. Included by GLSL and by C++.
#ifdef __cplusplus
#pragma once
#endif

#define LIST_STARTS_UNIT \
  18  // a particle: where its springs, hinges, triangles and membranes begin; the next one's end them
#define MESH_SPRINGS_UNIT 19  // a spring at a particle: other end, number, stiffness and rest length as bits
// A hinge, triangle or membrane at a particle: 4 * hinge + corner, triangle, or 4 * first texel + corner.
#define MESH_NUMBERS_UNIT 20
// HINGE_ROWS texels each: four particles; four coefficients as bits. Behind them MEMBRANE_ROWS each: three
// particles; three squares of rest lengths and six roots as bits.
#define HINGES_UNIT 21
#define MESH_TRIANGLES_UNIT 22   // three particles
#define LIMITED_SPRINGS_UNIT 23  // by number: both ends, rest length as bits
#define REST_PLACES_UNIT 24      // of particles: where they start

#define HINGE_ROWS 2
#define MEMBRANE_ROWS 3
#define STRUCTURAL_SPRING 0x80000000u  // set in the number of a structural spring at a particle
