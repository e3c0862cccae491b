// A value that never changes and that many hold: copying a Shared copies a pointer.
#pragma once

#include <concepts>
#include <memory>
#include <utility>

namespace clothsim {

template <class T>
class Shared {
 public:
  Shared() requires std::default_initializable<T> : value_(std::make_shared<const T>()) {}
  Shared(T value) : value_(std::make_shared<const T>(std::move(value))) {}
  Shared(const Shared&) = default;  // and no move: a Shared is never empty
  Shared& operator=(const Shared&) = default;

  [[nodiscard]] const T& operator*() const { return *value_; }
  [[nodiscard]] const T* operator->() const { return value_.get(); }

  // Whether both hold the very same value, not only an equal one.
  [[nodiscard]] bool isSameAs(const Shared& other) const { return value_ == other.value_; }
  friend bool operator==(const Shared& a, const Shared& b) { return a.isSameAs(b) || *a == *b; }
  friend bool operator==(const Shared& a, const T& b) { return *a == b; }

 private:
  std::shared_ptr<const T> value_;
};

}  // namespace clothsim
