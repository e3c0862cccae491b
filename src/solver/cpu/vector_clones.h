// Loops over particles are compiled for several instruction sets, chosen when the program starts; with
// contraction off (CMakeLists.txt) all of them give the same bits. Sanitizer builds and other compilers take
// the plain one.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define VECTOR_CLONES
#endif
#define INLINE [[gnu::always_inline]] inline
