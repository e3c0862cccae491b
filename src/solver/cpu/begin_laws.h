// The words of GLSL in which the laws in shaders/shared/ are written, until solver/cpu/end_laws.h. A type of
// the name of a macro stays as it is, since the macro needs parentheses.
#define LAW INLINE
#define precise
#define vec3(x, y, z) \
  vec3 { x, y, z }
