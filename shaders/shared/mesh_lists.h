// Springs, bending and triangles of meshes as the passes read them (src/solver/mesh_lists.h): buffers read as
// texels. Included by GLSL and by C++.
#ifdef __cplusplus
#pragma once
#endif

#define LIST_STARTS_UNIT \
  18  // a particle: where its springs, hinges and triangles begin; the next one's end them
#define MESH_SPRINGS_UNIT 19  // a spring at a particle: other end, number, stiffness and rest length as bits
#define MESH_NUMBERS_UNIT 20  // a hinge or triangle at a particle: 4 * hinge + corner, or triangle
#define HINGES_UNIT 21        // HINGE_ROWS texels each: four particles; four coefficients as bits
#define MESH_TRIANGLES_UNIT 22   // three particles
#define LIMITED_SPRINGS_UNIT 23  // by number: both ends, rest length as bits
#define REST_PLACES_UNIT 24      // of particles: where they start

#define HINGE_ROWS 2
#define STRUCTURAL_SPRING 0x80000000u  // set in the number of a structural spring at a particle
