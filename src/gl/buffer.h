// A typed, immutable-size buffer object, by direct state access; move-only.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gl/api.h"
#include "gl/bindings.h"

namespace clothsim::gl {

// Where bits are compared, new buffers hold this in every word, as they may where memory was used before: no
// number (0xffffffff), or one like any other. 0: what the driver leaves there.
inline GLuint uninitialisedWord = 0;

// The length of a buffer that holds so many bytes: never a power of two, and never 0 in bits 8 to 15.
// llvmpipe compiles a kernel again when one of its buffer textures becomes or ceases to be either.
constexpr std::size_t allocatedBytes(std::size_t bytes) {
  if ((bytes >> 8 & 0xff) == 0) bytes += 256;
  return std::has_single_bit(bytes) ? bytes + 16 : bytes;
}
static_assert(allocatedBytes(32) == 288 && allocatedBytes(256) == 272 && allocatedBytes(300) == 300 &&
              allocatedBytes(65536) == 65792);

template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  // An uninitialised buffer of `size` elements; a buffer of 0 elements holds one that nobody reads.
  Buffer(const std::string& label, std::size_t size) { make(label, size, nullptr); }
  Buffer(const std::string& label, std::span<const T> data) { make(label, data.size(), data.data()); }
  ~Buffer() { reset(); }
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }

  [[nodiscard]] GLuint name() const { return name_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return size_ * sizeof(T); }

  void upload(std::span<const T> data, std::size_t firstElement = 0) {
    assert(firstElement + data.size() <= size_ && "the data must fit into the buffer");
    glNamedBufferSubData(name_, static_cast<GLintptr>(firstElement * sizeof(T)),
                         static_cast<GLsizeiptr>(data.size_bytes()), data.data());
  }
  [[nodiscard]] std::vector<T> download() const { return download(0, size_); }
  [[nodiscard]] std::vector<T> download(std::size_t firstElement, std::size_t count) const {
    assert(firstElement + count <= size_ && "what is read must lie in the buffer");
    std::vector<T> data(count);
    if (count > 0)
      glGetNamedBufferSubData(name_, static_cast<GLintptr>(firstElement * sizeof(T)),
                              static_cast<GLsizeiptr>(count * sizeof(T)), data.data());
    return data;
  }
  // Fills it with zeros.
  void clear() { glClearNamedBufferData(name_, GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr); }
  // Copies another buffer, or so many of its first elements, to the beginning, on the device.
  void copyFrom(const Buffer& other) { copyFrom(other, other.size_); }
  void copyFrom(const Buffer& other, std::size_t count) {
    assert(count <= size_ && count <= other.size_ && "what is copied must lie in both buffers");
    glCopyNamedBufferSubData(other.name_, name_, 0, 0, static_cast<GLsizeiptr>(count * sizeof(T)));
  }
  void bindStorage(GLuint binding) const {
    if (KeptBindings::changes(KeptBindings::Kind::storage, binding, {name_}))
      glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, name_, 0, static_cast<GLsizeiptr>(usedBytes()));
  }
  // Binds it as the source of glDispatchComputeIndirect.
  void bindDispatches() const {
    if (KeptBindings::changes(KeptBindings::Kind::dispatches, 0, {name_}))
      glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, name_);
  }
  // The same of glDrawElementsIndirect.
  void bindDraws() const { glBindBuffer(GL_DRAW_INDIRECT_BUFFER, name_); }
  void bindStorageRange(GLuint binding, std::size_t firstElement, std::size_t count) const {
    bindRange(GL_SHADER_STORAGE_BUFFER, binding, firstElement, count);
  }
  void bindUniform(GLuint binding) const {
    if (KeptBindings::changes(KeptBindings::Kind::uniforms, binding, {name_}))
      glBindBufferBase(GL_UNIFORM_BUFFER, binding, name_);
  }
  void bindUniformRange(GLuint binding, std::size_t firstElement, std::size_t count) const {
    bindRange(GL_UNIFORM_BUFFER, binding, firstElement, count);
  }

 private:
  void make(const std::string& label, std::size_t size, const T* data) {
    glCreateBuffers(1, &name_);
    size_ = size;
    glNamedBufferStorage(name_, static_cast<GLsizeiptr>(allocatedBytes(usedBytes())), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    if (data != nullptr && size > 0)
      glNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(bytes()), data);
    else if (uninitialisedWord != 0 && usedBytes() % sizeof uninitialisedWord == 0)
      glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &uninitialisedWord);
    glObjectLabel(GL_BUFFER, name_, static_cast<GLsizei>(label.size()), label.c_str());
  }
  [[nodiscard]] std::size_t usedBytes() const { return (size_ > 0 ? size_ : 1) * sizeof(T); }
  void bindRange(GLenum target, GLuint binding, std::size_t first, std::size_t count) const {
    const auto kind =
        target == GL_UNIFORM_BUFFER ? KeptBindings::Kind::uniforms : KeptBindings::Kind::storage;
    const KeptBindings::Bound range{name_, first * sizeof(T), count * sizeof(T)};
    if (KeptBindings::changes(kind, binding, range))
      glBindBufferRange(target, binding, name_, static_cast<GLintptr>(range.first),
                        static_cast<GLsizeiptr>(range.bytes));
  }
  void reset() {
    if (name_ != 0) glDeleteBuffers(1, &name_);
    name_ = 0;
    size_ = 0;
  }
  void swap(Buffer& other) {
    std::swap(name_, other.name_);
    std::swap(size_, other.size_);
  }

  GLuint name_ = 0;
  std::size_t size_ = 0;
};

}  // namespace clothsim::gl
