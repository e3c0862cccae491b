// Time that the GPU takes for spans of commands. Nothing waits until the times are asked for.
#pragma once

#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

#include "gl/api.h"
#include "gl/context.h"

namespace clothsim::gl {

// By timer queries, of which it keeps a pool; on software renderers, whose queries answer 0 for compute work,
// by the host's clock around a glFinish.
class Timer {
 public:
  Timer() : byHost_(currentContextInfo().software) {}
  ~Timer() { glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data()); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  void begin() {
    if (byHost_) {
      glFinish();
      start_ = std::chrono::steady_clock::now();
      return;
    }
    if (pending_ == queries_.size()) {
      queries_.push_back(0);
      glCreateQueries(GL_TIME_ELAPSED, 1, &queries_.back());
    }
    glBeginQuery(GL_TIME_ELAPSED, queries_[pending_]);
  }
  void end() {
    if (byHost_) {
      glFinish();
      hostSeconds_.push_back(
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
      return;
    }
    glEndQuery(GL_TIME_ELAPSED);
    ++pending_;
  }
  // Those of the spans since the last call, in their order; waits for the device.
  [[nodiscard]] std::vector<double> takeSeconds() {
    std::vector<double> seconds = std::exchange(hostSeconds_, {});
    for (std::size_t i = 0; i < pending_; ++i) {
      GLuint64 nanoseconds = 0;
      glGetQueryObjectui64v(queries_[i], GL_QUERY_RESULT, &nanoseconds);
      seconds.push_back(static_cast<double>(nanoseconds) * 1e-9);
    }
    pending_ = 0;
    return seconds;
  }
  // That of the last span; waits for the device.
  [[nodiscard]] double seconds() { return takeSeconds().back(); }

 private:
  bool byHost_;
  std::vector<GLuint> queries_;
  std::size_t pending_ = 0;  // ended spans, of the first queries
  std::vector<double> hostSeconds_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace clothsim::gl
