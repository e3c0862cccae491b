// Time that the GPU takes for a span of commands; reading the result waits for it.
#pragma once

#include <chrono>

#include "gl/api.h"
#include "gl/context.h"

namespace clothsim::gl {

// By a timer query; on software renderers, whose queries answer 0 for compute work, by the host's clock
// around a glFinish.
class Timer {
 public:
  Timer() : byHost_(currentContextInfo().software) { glCreateQueries(GL_TIME_ELAPSED, 1, &name_); }
  ~Timer() { glDeleteQueries(1, &name_); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  void begin() {
    if (byHost_) {
      glFinish();
      start_ = std::chrono::steady_clock::now();
    } else {
      glBeginQuery(GL_TIME_ELAPSED, name_);
    }
  }
  void end() {
    if (byHost_) {
      glFinish();
      hostSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    } else {
      glEndQuery(GL_TIME_ELAPSED);
    }
  }
  [[nodiscard]] double seconds() const {
    if (byHost_) return hostSeconds_;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(name_, GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-9;
  }

 private:
  GLuint name_ = 0;
  bool byHost_;
  double hostSeconds_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace clothsim::gl
