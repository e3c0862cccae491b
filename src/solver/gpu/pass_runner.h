// Dispatches passes one after the other, each seeing what the one before has written, and times them when
// asked.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/context.h"
#include "gl/program.h"
#include "gl/timer.h"

namespace clothsim {

struct PassTime {
  std::string name;
  double seconds = 0;  // on the GPU, of all dispatches together
};

// What glDispatchComputeIndirect reads, in steps of 16 bytes.
struct Groups {
  std::uint32_t x = 0, y = 0, z = 0, unused = 0;
};

class PassRunner {
 public:
  // For the current context.
  PassRunner(int groupColumns, int groupRows)
      : groupColumns_(groupColumns), groupRows_(groupRows), flushes_(gl::currentContextInfo().needsFlushes) {}

  // One invocation a grid point.
  void run(const gl::Program& pass, const char* name, std::uint32_t columns, std::uint32_t rows);
  // `groups` work groups.
  void runGroups(const gl::Program& pass, const char* name, std::uint32_t groups);
  // As many work groups as the bound dispatch buffer says at that place.
  void runIndirect(const gl::Program& pass, const char* name, std::size_t place);

  // Between these, every dispatch is timed (which slows the whole), and times add up by name.
  void startTiming(gl::Timer& timer);
  [[nodiscard]] std::vector<PassTime> stopTiming();

 private:
  template <class Dispatch>
  void runTimed(const gl::Program& pass, const char* name, Dispatch dispatch);

  int groupColumns_, groupRows_;
  bool flushes_;
  gl::Timer* timer_ = nullptr;
  std::vector<PassTime> times_;
};

}  // namespace clothsim
