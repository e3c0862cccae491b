// What this machine could do at most: bytes that loops copy and operations that they do, measured on all
// threads as the CPU backend's own loops run. Times of steps are compared with it.
#pragma once

#include <cstddef>

namespace clothsim::cpu {

// Bytes read and written a second by a loop that scales one array into another, both together of `bytes`:
// as many as a simulation has show what its level of the cache gives. The best of several runs.
[[nodiscard]] double measureCopying(std::size_t bytes);
// Multiplications and additions of binary32 a second, without contraction, on numbers that stay in registers.
// The best of several runs.
[[nodiscard]] double measureArithmetic();

}  // namespace clothsim::cpu
