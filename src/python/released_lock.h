// Python's lock, given back while a simulation steps. An interpreter that ends (up to 3.13) unwinds each
// daemon thread that asks for the lock, through frames of C++ where that ends the process. Here such a thread
// waits for the end of the process instead.
#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>

#include <chrono>
#include <thread>

namespace clothsim {

template <class Take>
void takeLock(const Take& take) {
  try {
    take();
  } catch (const abi::__forced_unwind&) {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
}

class ReleasedLock {
 public:
  ReleasedLock() : thread_(PyEval_SaveThread()) {}
  ~ReleasedLock() {
    takeLock([this] { PyEval_RestoreThread(thread_); });
  }
  ReleasedLock(const ReleasedLock&) = delete;
  ReleasedLock& operator=(const ReleasedLock&) = delete;

 private:
  PyThreadState* thread_;
};

}  // namespace clothsim
