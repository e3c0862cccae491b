// The springs of seams as the passes read them (src/solver/mesh_lists.h): one buffer read as texels. Included
// by GLSL and by C++.
#ifdef __cplusplus
#pragma once
#endif

// For each particle, and once more, where its springs and its neighbours across seams begin; behind those the
// springs: other end, number of the seam, stiffness and length at the start as bits; then the neighbours.
#define SEAMS_UNIT 66
