// A level of the preconditioner and the next coarser one.
#include "sim/implicit/vertices.glsl"

layout(std140, binding = LEVEL_PARAMS_BINDING) uniform LevelBlock { LevelParams level; };
