// Loops over particles are compiled for several sets of instructions, of which vectorSet() chooses; with
// contraction off (CMakeLists.txt) all of them give the same bits. Sanitizer builds and other compilers have
// the plain one; under the address sanitizer laws stay functions (inlined everywhere, with a check at every
// access, they take a minute to compile).
#pragma once

#include "core/vector_set.h"

// g++ tells of the address sanitizer by a macro, clang++ by a feature.
#if defined(__SANITIZE_ADDRESS__)
#define HAS_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAS_ADDRESS_SANITIZER
#endif
#endif

// The function `result name parameters { return body; }`, compiled for each set. `values` are the parameters'
// names: VECTOR_CLONES(void, move, (float* x, int count), (x, count), moveAll(x, count))
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(HAS_ADDRESS_SANITIZER) && \
    !defined(__SANITIZE_THREAD__)
#define HAS_VECTOR_CLONES
#define AVX2_INSTRUCTIONS "avx2,bmi,bmi2,f16c,fma,lzcnt,movbe"
#define AVX512_INSTRUCTIONS AVX2_INSTRUCTIONS ",avx512f,avx512bw,avx512cd,avx512dq,avx512vl"
#define VECTOR_CLONES(result, name, parameters, values, ...)                                             \
  [[gnu::target(AVX512_INSTRUCTIONS)]] static result name##WithAvx512 parameters { return __VA_ARGS__; } \
  [[gnu::target(AVX2_INSTRUCTIONS)]] static result name##WithAvx2 parameters { return __VA_ARGS__; }     \
  static result name##Plainly parameters { return __VA_ARGS__; }                                         \
  result name parameters {                                                                               \
    switch (vectorSet()) {                                                                               \
      case VectorSet::avx512:                                                                            \
        return name##WithAvx512 values;                                                                  \
      case VectorSet::avx2:                                                                              \
        return name##WithAvx2 values;                                                                    \
      case VectorSet::plain:                                                                             \
        break;                                                                                           \
    }                                                                                                    \
    return name##Plainly values;                                                                         \
  }
#else
#define VECTOR_CLONES(result, name, parameters, values, ...) \
  result name parameters { return __VA_ARGS__; }
#endif

#if defined(HAS_ADDRESS_SANITIZER)
#define INLINE inline
#else
#define INLINE [[gnu::always_inline]] inline
#endif
