// Counts calls of OpenGL, with a function of its own in front of the loader's pointers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "gl/api.h"
#include "gl/called_gl_functions.h"

namespace clothsim::test {

struct GlCounts {
  std::map<std::string, std::uint64_t> calls;  // by the function's name
  std::uint64_t uploadedBytes = 0, readBytes = 0;

  [[nodiscard]] std::uint64_t of(const std::string& function) const {
    const auto found = calls.find(function);
    return found == calls.end() ? 0 : found->second;
  }
  [[nodiscard]] std::uint64_t dispatches() const {
    return of("glDispatchCompute") + of("glDispatchComputeIndirect");
  }
  [[nodiscard]] std::uint64_t all() const {
    std::uint64_t sum = 0;
    for (const auto& [function, count] : calls) sum += count;
    return sum;
  }
};

// What the living counters write to.
inline GlCounts glCounts;
// With it dispatches and drawing are counted, but not done.
inline bool leavesWorkOut = false;

// Puts a counter in front of a function pointer of the loader for as long as it lives.
template <auto& Pointer>
class Counted;

template <class Result, class... Arguments, Result (*&Pointer)(Arguments...)>
class Counted<Pointer> {
 public:
  explicit Counted(const char* name) {
    name_ = name;
    original_ = Pointer;
    Pointer = &count;
  }
  ~Counted() { Pointer = original_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  template <class Other>
  static constexpr bool is(Other& other) {
    return static_cast<const void*>(&Pointer) == static_cast<const void*>(&other);
  }

  static Result count(Arguments... arguments) {
    ++glCounts.calls[name_];
    constexpr bool isWork = is(glad_glDispatchCompute) || is(glad_glDispatchComputeIndirect) ||
                            is(glad_glDrawArrays) || is(glad_glDrawArraysIndirect) ||
                            is(glad_glDrawArraysInstancedBaseInstance) || is(glad_glDrawElements) ||
                            is(glad_glDrawElementsInstanced) || is(glad_glDrawElementsInstancedBaseInstance);
    if constexpr (isWork)
      if (leavesWorkOut) return;
    if constexpr (is(glad_glNamedBufferSubData))  // (buffer, offset, size, data)
      glCounts.uploadedBytes += static_cast<std::uint64_t>(std::get<2>(std::tuple(arguments...)));
    if constexpr (is(glad_glGetNamedBufferSubData))
      glCounts.readBytes += static_cast<std::uint64_t>(std::get<2>(std::tuple(arguments...)));
    return original_(arguments...);
  }
  static inline const char* name_ = nullptr;
  static inline Result (*original_)(Arguments...) = nullptr;
};

#define COUNTED(function) const test::Counted<glad_##function> counted_##function(#function)

// Counts every function that the program calls, and does none of the work, while it lives.
class CountsOnly {
 public:
  CountsOnly() {
    glCounts = {};
    leavesWorkOut = true;
  }
  ~CountsOnly() { leavesWorkOut = false; }
  CountsOnly(const CountsOnly&) = delete;
  CountsOnly& operator=(const CountsOnly&) = delete;

 private:
#define COUNTED_MEMBER(function) const Counted<glad_##function> counted_##function{#function};
  CALLED_GL_FUNCTIONS(COUNTED_MEMBER)
#undef COUNTED_MEMBER
};

}  // namespace clothsim::test
