// Dispatches passes one after the other, each seeing what the one before has written, and times them when
// asked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/context.h"
#include "gl/program.h"
#include "gl/timer.h"
#include "solver/executor.h"

namespace clothsim {

// What glDispatchComputeIndirect reads, in steps of 16 bytes.
struct Groups {
  std::uint32_t x = 0, y = 0, z = 0, unused = 0;
  [[nodiscard]] std::uint32_t count() const { return x * y * z; }
};

class PassRunner {
 public:
  // While one lives, the passes' dispatches write nothing that others of them read, so that none waits for
  // another: one barrier stands behind them all.
  class SideBySide {
   public:
    explicit SideBySide(PassRunner& runner) : runner_(&runner) { runner.sideBySide_ = true; }
    ~SideBySide() { runner_->awaitAll(); }
    SideBySide(const SideBySide&) = delete;
    SideBySide& operator=(const SideBySide&) = delete;

   private:
    PassRunner* runner_;
  };

  // For the current context.
  PassRunner() : flushes_(gl::currentContextInfo().needsFlushes) {}

  // At least columns x rows invocations.
  void run(const gl::Program& pass, const std::string& name, std::uint32_t columns, std::uint32_t rows);
  // `groups` work groups, or `across` x `along`.
  void runGroups(const gl::Program& pass, const std::string& name, std::uint32_t groups);
  void runGroups(const gl::Program& pass, const std::string& name, std::uint32_t across, std::uint32_t along);
  // The counts of work groups for runIndirect, as the passes so far have written them. The passes' own
  // barriers leave them out, because few are followed by a reader of counts.
  void takeCounts(const gl::Buffer<Groups>& counts);
  // As many work groups as those counts say at that place.
  void runIndirect(const gl::Program& pass, const std::string& name, std::size_t place);

  // Between these, every dispatch is timed (which slows the whole), and times add up by name. Names
  // serve for nothing else.
  void startTiming();
  [[nodiscard]] std::vector<PassTime> stopTiming();
  [[nodiscard]] bool isTiming() const { return timer_.has_value(); }

 private:
  template <class Dispatch>
  void runTimed(const gl::Program& pass, const std::string& name, Dispatch dispatch);
  void awaitWrites();
  void awaitAll();  // those side by side
  bool flushes_;
  bool sideBySide_ = false, hasUnawaited_ = false;
  std::optional<gl::Timer> timer_;
  std::vector<std::string> timed_;  // the names of the timer's spans
};

}  // namespace clothsim
