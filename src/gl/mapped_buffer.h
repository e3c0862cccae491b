// A buffer whose memory the host reads while commands go on writing to it; move-only. When what was written
// may be read, a Fence behind the commands says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "gl/api.h"
#include "gl/buffer.h"
#include "gl/context.h"

namespace clothsim::gl {

template <class T>
class MappedBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  MappedBuffer() = default;
  // @throws OpenGlError when there is no memory to map
  MappedBuffer(const std::string& label, std::size_t size) : size_(size) {
    constexpr GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const auto bytes = static_cast<GLsizeiptr>(size * sizeof(T));
    glCreateBuffers(1, &name_);
    glNamedBufferStorage(name_, bytes, nullptr, access | GL_CLIENT_STORAGE_BIT);
    glObjectLabel(GL_BUFFER, name_, static_cast<GLsizei>(label.size()), label.c_str());
    elements_ = static_cast<const T*>(glMapNamedBufferRange(name_, 0, bytes, access));
    if (elements_ != nullptr) return;
    glDeleteBuffers(1, &name_);
    throw OpenGlError("the driver gives no memory for " + label);
  }
  ~MappedBuffer() {
    if (name_ != 0) glDeleteBuffers(1, &name_);  // which unmaps it
  }
  MappedBuffer(MappedBuffer&& other) noexcept { swap(other); }
  MappedBuffer& operator=(MappedBuffer&& other) noexcept {
    swap(other);
    return *this;
  }

  [[nodiscard]] std::span<const T> elements() const { return {elements_, size_}; }
  // Asks for a copy of some elements of another buffer, to the same places.
  void copyFrom(const Buffer<T>& other, std::size_t first, std::size_t count) {
    glCopyNamedBufferSubData(other.name(), name_, static_cast<GLintptr>(first * sizeof(T)),
                             static_cast<GLintptr>(first * sizeof(T)),
                             static_cast<GLsizeiptr>(count * sizeof(T)));
  }

 private:
  void swap(MappedBuffer& other) {
    std::swap(name_, other.name_);
    std::swap(size_, other.size_);
    std::swap(elements_, other.elements_);
  }

  GLuint name_ = 0;
  std::size_t size_ = 0;
  const T* elements_ = nullptr;
};

// A mark behind the commands so far.
class Fence {
 public:
  Fence() = default;
  ~Fence() { reset(); }
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  // Sets the mark here; the one before is forgotten.
  void set() {
    reset();
    sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  }
  [[nodiscard]] bool isSet() const { return sync_ != nullptr; }
  // Whether the commands before the mark are done; does not wait. Without a mark: no.
  [[nodiscard]] bool isReached() const {
    if (sync_ == nullptr) return false;
    const GLenum answer = glClientWaitSync(sync_, 0, 0);
    return answer == GL_ALREADY_SIGNALED || answer == GL_CONDITION_SATISFIED;
  }
  // Waits until the commands before the mark are done, not for those behind it. @throws ContextLost
  void wait() {
    constexpr GLuint64 second = 1'000'000'000;
    while (sync_ != nullptr) {
      const GLenum answer = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, second);
      checkContext();
      if (answer != GL_TIMEOUT_EXPIRED) reset();
    }
  }
  // Forgets the mark.
  void reset() {
    if (sync_ != nullptr) glDeleteSync(sync_);
    sync_ = nullptr;
  }

 private:
  GLsync sync_ = nullptr;
};

}  // namespace clothsim::gl
