// GPU time of a span of commands, by timer queries; reading the result waits for it.
#pragma once

#include "gl/api.h"

namespace clothsim::gl {

class Timer {
 public:
  Timer() { glCreateQueries(GL_TIME_ELAPSED, 1, &name_); }
  ~Timer() { glDeleteQueries(1, &name_); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  void begin() { glBeginQuery(GL_TIME_ELAPSED, name_); }
  void end() { glEndQuery(GL_TIME_ELAPSED); }
  [[nodiscard]] double seconds() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(name_, GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-9;
  }

 private:
  GLuint name_ = 0;
};

}  // namespace clothsim::gl
