// Loops over particles are compiled for several instruction sets, chosen when the program starts; with
// contraction off (CMakeLists.txt) all of them give the same bits. Sanitizer builds (whose own start comes
// after the choice) and other compilers take the plain one; there, laws stay functions (inlined everywhere,
// with a check at every access, they take a minute to compile).
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define VECTOR_CLONES
#endif
#if defined(__SANITIZE_ADDRESS__)
#define INLINE inline
#else
#define INLINE [[gnu::always_inline]] inline
#endif
