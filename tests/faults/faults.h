// Makes the n-th call of one kind fail: an allocation, or a call to the operating system. This test program's
// own definitions of those calls stand before the C library's.
#pragma once

#include <functional>

namespace clothsim::test {

enum class Fault { none, allocate, open, write, synchronise, close, rename, stat };

struct Outcome {
  int exitCode = -1;  // 128 + the signal's number, where a signal ended it
  int calls = 0;      // of that kind
};

// Runs `work` in a process of its own, its output in the file `output`. Of the calls of that kind the n-th
// fails, counted from 1; with `forGood` so do all after it, as on a disk that is full.
[[nodiscard]] Outcome runWithFault(Fault fault, int n, bool forGood, const char* output,
                                   const std::function<int()>& work);

}  // namespace clothsim::test
