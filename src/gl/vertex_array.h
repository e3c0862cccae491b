// Which buffers feed which vertex attributes, by direct state access; move-only. Keeps no buffer alive.
#pragma once

#include <string>
#include <utility>

#include "gl/api.h"

namespace clothsim::gl {

// Where an attribute's floats come from: each vertex takes the next `stride` bytes, or each instance.
struct VertexStream {
  GLuint location = 0;
  int components = 4;
  GLsizei stride = 16;  // [bytes]
  GLuint offset = 0;    // [bytes]
  bool perInstance = false;
};

class VertexArray {
 public:
  VertexArray() = default;
  explicit VertexArray(const std::string& label) {
    glCreateVertexArrays(1, &name_);
    glObjectLabel(GL_VERTEX_ARRAY, name_, static_cast<GLsizei>(label.size()), label.c_str());
  }
  ~VertexArray() {
    if (name_ != 0) glDeleteVertexArrays(1, &name_);
  }
  VertexArray(VertexArray&& other) noexcept { std::swap(name_, other.name_); }
  VertexArray& operator=(VertexArray&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }

  // Every attribute has its own binding point of the same number.
  void attach(GLuint buffer, const VertexStream& stream) {
    glEnableVertexArrayAttrib(name_, stream.location);
    glVertexArrayAttribFormat(name_, stream.location, stream.components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(name_, stream.location, stream.location);
    glVertexArrayBindingDivisor(name_, stream.location, stream.perInstance ? 1 : 0);
    glVertexArrayVertexBuffer(name_, stream.location, buffer, stream.offset, stream.stride);
  }
  void attachIndices(GLuint buffer) { glVertexArrayElementBuffer(name_, buffer); }
  void bind() const { glBindVertexArray(name_); }
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

}  // namespace clothsim::gl
